// Runs a sweep: every point once a round, so that what a busy machine does to one it does to all. What is done is on disk after each
// round, whoever interrupts. Decides nothing about what is measured: that is the sweep's.
#pragma once

#include "tools/lab/results.h"

#include <chrono>
#include <memory>

namespace antumbra::lab {

/// Lines on stderr, not too many.
class Progress
{
public:
    void tell(const std::string& line);

private:
    std::chrono::steady_clock::time_point told_{};
};

class Lab
{
public:
    /// Results are FOLDER/NAME.json and .csv; `resumes` goes on from those that are there. Loads every scene; throws Error for one that
    /// does not load, for results of something else, and where there is no device.
    Lab(app::Sweep sweep, Path folder, bool resumes);

    /// False where somebody interrupted it.
    bool run();

private:
    [[nodiscard]] Path file(std::string_view extension) const;
    void save() const;
    Bench& benchOf(const app::SweepPoint& point);
    bool warmUp();
    bool measureErrors();
    bool measureErrors(Bench& bench, uint32_t samples);
    bool measureTimes();
    /// For all visits still to be made, as the warm-up makes expect.
    [[nodiscard]] double secondsLeft() const;

    app::Sweep sweep_;
    Path folder_;
    gpu::Device device_{{}};
    std::vector<std::unique_ptr<Bench>> benches_;
    Results results_;
    std::vector<double> milliseconds_; // a frame, one a row
    app::InterruptGuard interrupt_;
    Progress progress_;
};

} // namespace antumbra::lab
