#include "tools/fit_ltc/progress.h"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <unistd.h>

namespace antumbra::fit {

namespace {

constexpr std::chrono::milliseconds kDrawInterval{250};
constexpr std::chrono::seconds kLineInterval{5};
constexpr double kLeastTold = 0.005; // nothing is known of the time before

std::string timeLeft(double seconds)
{
    const auto whole = static_cast<int>(std::ceil(seconds));
    return fmt::format("{}:{:02} left", whole / 60, whole % 60);
}

} // namespace

ProgressLine::ProgressLine() : isTerminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine()
{
    if (isOpen_)
        fmt::print(stderr, "\n");
}

void ProgressLine::show(double share)
{
    const Clock::time_point now = Clock::now();
    if (share < kLeastTold || now - shown_ < (isTerminal_ ? Clock::duration(kDrawInterval) : Clock::duration(kLineInterval)))
        return;
    shown_ = now;
    const double seconds = std::chrono::duration<double>(now - started_).count();
    fmt::print(stderr, "{}fit {:3.0f} %  {}{}", isTerminal_ ? "\r\x1b[K" : "", std::floor(100 * share),
               timeLeft(seconds * (1 - share) / share), isTerminal_ ? "" : "\n");
    isOpen_ = isTerminal_;
    std::fflush(stderr);
}

} // namespace antumbra::fit
