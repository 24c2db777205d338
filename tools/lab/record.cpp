#include "tools/lab/record.h"

#include "base/log.h"

#include <cmath>
#include <fmt/format.h>

namespace antumbra::lab {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kSilence{2};

} // namespace

std::string minutes(double seconds)
{
    const auto whole = static_cast<int>(std::ceil(seconds));
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

void Progress::tell(const std::string& line)
{
    if (Clock::now() - told_ < kSilence)
        return;
    told_ = Clock::now();
    logInfo("{}", line);
}

Path Record::file(std::string_view extension) const { return folder_ / fmt::format("{}.{}", results.sweep, extension); }

void Record::resumeFromDisk()
{
    if (std::filesystem::exists(file("json")))
        resume(results, file("json"));
}

void Record::save() const
{
    writeText(file("json"), jsonOf(results));
    writeText(file("csv"), csvOf(results));
}

void Record::finish(std::span<const std::string_view> columns) const
{
    save();
    fmt::print("{}{}\n{}\n", tableOf(results, columns), file("json").string(), file("csv").string());
}

} // namespace antumbra::lab
