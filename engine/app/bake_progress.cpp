#include "app/bake_progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace antumbra::app {

namespace {

constexpr std::chrono::seconds kLineInterval{5};

std::string duration(double seconds)
{
    const auto whole = static_cast<uint64_t>(std::ceil(std::min(seconds, 1.0e9)));
    return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                        : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

} // namespace

ProgressBar::ProgressBar() : isTerminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar()
{
    if (isOpen_)
        fmt::print(stderr, "\n");
}

void ProgressBar::show(const bake::BakeProgress& progress)
{
    const auto now = std::chrono::steady_clock::now();
    if (isTerminal_) {
        fmt::print(stderr, "\r\x1b[K{}", describe(progress));
        isOpen_ = true;
    } else if (now - shown_ >= kLineInterval) {
        fmt::print(stderr, "{}\n", describe(progress));
        shown_ = now;
    }
    std::fflush(stderr);
}

std::string describe(const bake::BakeProgress& progress)
{
    constexpr size_t kWidth = 30;
    const double share = progress.raysAll > 0 ? static_cast<double>(progress.raysDone) / static_cast<double>(progress.raysAll) : 1;
    const auto filled = static_cast<size_t>(share * kWidth);
    std::string bar =
        fmt::format("[{:=<{}}{: <{}}] {:3.0f} %  {}", "", filled, "", kWidth - filled, std::floor(100 * share), progress.stage);
    if (progress.raysPerSecond == 0)
        return bar;
    return fmt::format("{}  {:.2f} Mrays/s  {} left", bar, 1.0e-6 * progress.raysPerSecond, duration(progress.secondsLeft));
}

} // namespace antumbra::app
