#include "tools/lab/lab.h"

#include "base/log.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace antumbra::lab {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kSilence{2};

std::string minutes(double seconds)
{
    const auto whole = static_cast<int>(std::ceil(seconds));
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace

void Progress::tell(const std::string& line)
{
    if (Clock::now() - told_ < kSilence)
        return;
    told_ = Clock::now();
    logInfo("{}", line);
}

Lab::Lab(app::Sweep sweep, Path folder, bool resumes) : sweep_(std::move(sweep)), folder_(std::move(folder))
{
    results_ = {.sweep = sweep_.name, .device = device_.info(), .rows = {}};
    for (const app::SweepPoint& point : sweep_.points)
        results_.rows.push_back({.point = point, .knobs = benchOf(point).knobsOf(point)});
    if (resumes && std::filesystem::exists(file("json")))
        resume(results_, file("json"));
    milliseconds_.resize(results_.rows.size());
}

Path Lab::file(std::string_view extension) const { return folder_ / fmt::format("{}.{}", sweep_.name, extension); }

void Lab::save() const
{
    writeText(file("json"), jsonOf(results_));
    writeText(file("csv"), csvOf(results_));
}

Bench& Lab::benchOf(const app::SweepPoint& point)
{
    const auto found = std::ranges::find_if(benches_, [&](const auto& bench) { return bench->fits(point); });
    return found != benches_.end() ? **found : *benches_.emplace_back(std::make_unique<Bench>(device_, point));
}

bool Lab::run()
{
    const bool isDone = warmUp() && measureErrors() && measureTimes();
    save();
    fmt::print("{}{}\n{}\n", tableOf(results_), file("json").string(), file("csv").string());
    return isDone;
}

bool Lab::warmUp()
{
    for (size_t i = 0; i < results_.rows.size(); ++i) {
        if (interrupt_.isInterrupted())
            return false;
        const app::SweepPoint& point = results_.rows[i].point;
        progress_.tell(fmt::format("warm-up, {} of {}: {}", i + 1, results_.rows.size(), point.name));
        milliseconds_[i] = benchOf(point).warmUp(point, sweep_.warmUp);
    }
    return true;
}

bool Lab::measureErrors()
{
    for (const std::unique_ptr<Bench>& bench : benches_) {
        uint32_t samples = 0;
        for (const Row& row : results_.rows)
            if (bench->fits(row.point) && !row.error)
                samples = std::max(samples, row.point.referenceSamples);
        if (samples > 0 && !measureErrors(*bench, samples))
            return false;
    }
    return true;
}

bool Lab::measureErrors(Bench& bench, uint32_t samples)
{
    const Clock::time_point start = Clock::now();
    const auto tell = [&](uint32_t done) {
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        const double left = done < samples ? seconds * (samples - done) / done : 0;
        progress_.tell(fmt::format("reference, {} of {} samples, {} left", done, samples, minutes(left)));
    };
    if (!bench.accumulate(samples, interrupt_, tell))
        return false;
    for (Row& row : results_.rows)
        if (bench.fits(row.point) && row.point.referenceSamples > 0 && !row.error)
            row.error = bench.errorOf(row.point);
    save();
    return true;
}

double Lab::secondsLeft() const
{
    double milliseconds = 0;
    for (size_t i = 0; i < results_.rows.size(); ++i) {
        const Row& row = results_.rows[i];
        if (row.rounds < sweep_.repeats)
            milliseconds += (sweep_.repeats - row.rounds) * Bench::framesOf(row.point) * milliseconds_[i];
    }
    return 1e-3 * milliseconds;
}

bool Lab::measureTimes()
{
    for (uint32_t round = 0; round < sweep_.repeats; ++round) {
        for (Row& row : results_.rows) {
            if (row.rounds > round)
                continue;
            progress_.tell(fmt::format("round {} of {}: {}, {} left", round + 1, sweep_.repeats, row.point.name, minutes(secondsLeft())));
            const std::optional<Samples> samples = benchOf(row.point).measure(row.point, interrupt_);
            if (!samples)
                return false;
            row.samples.append(*samples);
            ++row.rounds;
        }
        save();
    }
    return true;
}

} // namespace antumbra::lab
