// Runs a sweep of bakes: every point once a round. What is done is on disk after each bake, whoever interrupts.
#pragma once

#include "app/interrupt.h"
#include "tools/lab/record.h"

namespace antumbra::lab {

class BakeLab
{
public:
    /// `resumes` goes on from the results that are in `folder`. Throws Error for a scene that does not load and for results of something
    /// else.
    BakeLab(app::Sweep sweep, const Path& folder, bool resumes);

    /// False where somebody interrupted it.
    bool run();

private:
    bool measureAll();
    bool measure(Row& row);

    app::Sweep sweep_;
    Record record_;
    app::InterruptGuard interrupt_;
    Progress progress_;
};

} // namespace antumbra::lab
