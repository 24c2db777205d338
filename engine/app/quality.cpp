#include "app/quality.h"

#include <algorithm>

namespace antumbra::app {

namespace {

constexpr uint32_t kFramesALook = 20;
constexpr double kRoomToRise = 0.6;
constexpr uint32_t kLeastSamples = 32;

uint32_t halved(uint32_t samples) { return std::max(kLeastSamples, samples / 2 / kLeastSamples * kLeastSamples); }

} // namespace

QualityControl::QualityControl(double targetMilliseconds, const render::Knobs& best) : target_(targetMilliseconds)
{
    uint32_t samples = best.occlusion.samples;
    auto edge = static_cast<uint32_t>(best.occlusion.scale);
    levels_.push_back({samples, best.occlusion.scale});
    while (samples > kLeastSamples || edge < static_cast<uint32_t>(render::Scale::Quarter)) {
        if (samples > kLeastSamples)
            samples = halved(samples);
        else
            edge *= 2;
        levels_.push_back({samples, static_cast<render::Scale>(edge)});
    }
}

void QualityControl::take(double milliseconds, render::Knobs& knobs)
{
    sum_ += milliseconds;
    if (++frames_ < kFramesALook)
        return;
    const double mean = sum_ / frames_;
    sum_ = 0;
    frames_ = 0;
    if (mean > target_ && level_ + 1 < levels_.size())
        ++level_;
    else if (mean < kRoomToRise * target_ && level_ > 0)
        --level_;
    else
        return;
    knobs.occlusion.samples = levels_[level_].samples;
    knobs.occlusion.scale = levels_[level_].scale;
}

} // namespace antumbra::app
