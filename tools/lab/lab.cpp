#include "tools/lab/lab.h"

#include <algorithm>
#include <fmt/format.h>

namespace antumbra::lab {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kColumns[] = {"frame", "occlusion trace", "area analytic", "area triangles", "area traced"};

} // namespace

Lab::Lab(app::Sweep sweep, const Path& folder, bool resumes)
    : sweep_(std::move(sweep)), record_({.sweep = sweep_.name, .device = device_.info(), .rows = {}}, folder)
{
    for (const app::SweepPoint& point : sweep_.points)
        record_.results.rows.push_back({.point = point, .knobs = benchOf(point).knobsOf(point)});
    if (resumes)
        record_.resumeFromDisk();
    milliseconds_.resize(record_.results.rows.size());
}

Bench& Lab::benchOf(const app::SweepPoint& point)
{
    const auto found = std::ranges::find_if(benches_, [&](const auto& bench) { return bench->fits(point); });
    return found != benches_.end() ? **found : *benches_.emplace_back(std::make_unique<Bench>(device_, point));
}

bool Lab::run()
{
    const bool isDone = warmUp() && measureErrors() && measureTimes();
    record_.finish(kColumns);
    if (isDone && sweep_.fit)
        fmt::print("{}", fitOf(record_.results, *sweep_.fit));
    return isDone;
}

bool Lab::warmUp()
{
    for (size_t i = 0; i < record_.results.rows.size(); ++i) {
        if (interrupt_.isInterrupted())
            return false;
        const app::SweepPoint& point = record_.results.rows[i].point;
        progress_.tell(fmt::format("warm-up, {} of {}: {}", i + 1, record_.results.rows.size(), point.name));
        milliseconds_[i] = benchOf(point).warmUp(point, sweep_.warmUp);
    }
    return true;
}

bool Lab::measureErrors()
{
    for (const std::unique_ptr<Bench>& bench : benches_) {
        uint32_t samples = 0;
        for (const Row& row : record_.results.rows)
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
    for (Row& row : record_.results.rows)
        if (bench.fits(row.point) && row.point.referenceSamples > 0 && !row.error)
            row.error = bench.errorOf(row.point);
    record_.save();
    return true;
}

double Lab::secondsLeft() const
{
    double milliseconds = 0;
    for (size_t i = 0; i < record_.results.rows.size(); ++i) {
        const Row& row = record_.results.rows[i];
        if (row.rounds < sweep_.repeats)
            milliseconds += (sweep_.repeats - row.rounds) * Bench::framesOf(row.point) * milliseconds_[i];
    }
    return 1e-3 * milliseconds;
}

bool Lab::measureTimes()
{
    for (uint32_t round = 0; round < sweep_.repeats; ++round) {
        for (Row& row : record_.results.rows) {
            if (row.rounds > round)
                continue;
            progress_.tell(fmt::format("round {} of {}: {}, {} left", round + 1, sweep_.repeats, row.point.name, minutes(secondsLeft())));
            const std::optional<Samples> samples = benchOf(row.point).measure(row.point, interrupt_);
            if (!samples)
                return false;
            row.samples.append(*samples);
            ++row.rounds;
        }
        record_.save();
    }
    return true;
}

} // namespace antumbra::lab
