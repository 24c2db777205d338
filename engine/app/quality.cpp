#include "app/quality.h"

#include <algorithm>
#include <cmath>

namespace antumbra::app {

namespace {

constexpr uint32_t kUnsettledFrames = 4; // after a change: pipelines and images are made, older frames are still in flight
constexpr double kRoomToRise = 0.9;      // of the target
constexpr uint32_t kGreatestPatience = 64;
constexpr uint32_t kLeastSamples = 32;

uint32_t halved(uint32_t samples) { return std::max(kLeastSamples, samples / 2 / kLeastSamples * kLeastSamples); }

} // namespace

double QualityControl::Level::rays() const
{
    const auto edge = static_cast<double>(scale);
    return samples / (edge * edge);
}

bool QualityControl::Level::isWithin(const render::Knobs& knobs) const
{
    return samples <= knobs.occlusion.samples && scale >= knobs.occlusion.scale;
}

QualityControl::QualityControl(double targetMilliseconds, const render::Knobs& best, const render::Knobs& knobs)
    : target_(targetMilliseconds)
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
        // Between a frame that is all rays and one that has none.
        Level& above = levels_[levels_.size() - 2];
        above.dearer = std::sqrt(above.rays() / levels_.back().rays());
    }
    while (level_ < lowestLevel() && !levels_[level_].isWithin(knobs))
        ++level_;
    seenLevel_ = level_;
}

bool QualityControl::take(double milliseconds, render::Knobs& knobs)
{
    if (unsettledFrames_ > 0) {
        --unsettledFrames_;
        return false;
    }
    times_[frames_++] = milliseconds;
    if (frames_ < kFramesALook)
        return false;
    look();
    const size_t next = nextLevel();
    if (next == level_)
        return false;
    if (next > level_ && hasRisen_)
        patience_ = std::min(2 * patience_, kGreatestPatience);
    hasRisen_ = next < level_;
    looksWithRoom_ = 0;
    level_ = next;
    unsettledFrames_ = kUnsettledFrames;
    knobs.occlusion.samples = levels_[level_].samples;
    knobs.occlusion.scale = levels_[level_].scale;
    return true;
}

void QualityControl::look()
{
    frames_ = 0;
    auto* const middle = times_.data() + kFramesALook / 2;
    std::nth_element(times_.data(), middle, times_.data() + kFramesALook);
    const double before = median_;
    median_ = *middle;
    if (seenLevel_ != level_)
        learn(before);
    seenLevel_ = level_;
}

// `before` was measured at seenLevel_. What else loads the machine may have changed in between, but fewer rays never cost more, and
// the frame never grows by more than its rays.
void QualityControl::learn(double before)
{
    Level& above = levels_[std::min(level_, seenLevel_)];
    const Level& below = levels_[std::max(level_, seenLevel_)];
    const double seen = level_ > seenLevel_ ? before / median_ : median_ / before;
    above.dearer = std::clamp(seen, 1.0, above.rays() / below.rays());
}

size_t QualityControl::nextLevel()
{
    if (median_ > target_)
        return std::min(level_ + 1, lowestLevel());
    const bool hasRoom = level_ > 0 && median_ * levels_[level_ - 1].dearer <= kRoomToRise * target_;
    looksWithRoom_ = hasRoom ? looksWithRoom_ + 1 : 0;
    return looksWithRoom_ >= patience_ ? level_ - 1 : level_;
}

} // namespace antumbra::app
