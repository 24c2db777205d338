// Holds a frame time by giving up quality of the occlusion pass: fewer samples first, then a coarser trace. Measures nothing itself,
// and changes nothing but these two knobs.
#pragma once

#include "render/knobs.h"

#include <vector>

namespace antumbra::app {

/// Looks at the mean of 20 frames at a time. Above the target it goes one level down, below 60 % of it one level up again: the
/// levels halve the cost, so what it goes up to still fits. Level 0 is what the knobs were at the start, never better.
class QualityControl
{
public:
    QualityControl(double targetMilliseconds, const render::Knobs& best);

    /// Once a frame, with its time. Writes `knobs` when it changes level.
    void take(double milliseconds, render::Knobs& knobs);

private:
    struct Level
    {
        uint32_t samples;
        render::Scale scale;
    };

    double target_;
    std::vector<Level> levels_;
    size_t level_ = 0;
    double sum_ = 0;
    uint32_t frames_ = 0;
};

} // namespace antumbra::app
