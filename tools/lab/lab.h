// Runs a sweep: every point once a round, so that what a busy machine does to one it does to all. What is done is on disk after each
// round, whoever interrupts. Decides nothing about what is measured: that is the sweep's.
#pragma once

#include "app/interrupt.h"
#include "tools/lab/bench.h"
#include "tools/lab/record.h"

#include <memory>

namespace antumbra::lab {

class Lab
{
public:
    /// `resumes` goes on from the results that are in `folder`. Loads every scene; throws Error for one that
    /// does not load, for results of something else, and where there is no device.
    Lab(app::Sweep sweep, const Path& folder, bool resumes);

    /// False where somebody interrupted it.
    bool run();

private:
    Bench& benchOf(const app::SweepPoint& point);
    bool warmUp();
    bool measureErrors();
    bool measureErrors(Bench& bench, uint32_t samples);
    bool measureTimes();
    /// For all visits still to be made, as the warm-up makes expect.
    [[nodiscard]] double secondsLeft() const;

    app::Sweep sweep_;
    gpu::Device device_{{}};
    std::vector<std::unique_ptr<Bench>> benches_;
    Record record_;
    std::vector<double> milliseconds_; // a frame, one a row
    app::InterruptGuard interrupt_;
    Progress progress_;
};

} // namespace antumbra::lab
