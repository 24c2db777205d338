// How far the fit is, on stderr: a line that is drawn over itself in a terminal, one every few seconds elsewhere.
#pragma once

#include <chrono>

namespace antumbra::fit {

class ProgressLine
{
public:
    ProgressLine();
    /// Leaves the last one on a line of its own.
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `share` of the work that is done, 0..1.
    void show(double share);

private:
    using Clock = std::chrono::steady_clock;

    bool isTerminal_;
    bool isOpen_ = false;
    Clock::time_point started_ = Clock::now();
    Clock::time_point shown_{};
};

} // namespace antumbra::fit
