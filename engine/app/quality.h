// Holds a frame time with the occlusion pass as good as it can be: coming down, fewer samples first, then a coarser trace. Measures
// nothing itself, and changes nothing but these two knobs.
#pragma once

#include "render/knobs.h"

#include <array>
#include <vector>

namespace antumbra::app {

/// Looks at the median of 20 frames at a time. Above the target it goes one level down; it goes up again only where the level above
/// would hold the target too, by how much dearer that one was when last seen. Each time it has to come down from there again, it
/// waits longer before the next try.
class QualityControl
{
public:
    /// Level 0 is `best`, and nothing is ever better; begins at `knobs`, or the next lower level.
    QualityControl(double targetMilliseconds, const render::Knobs& best, const render::Knobs& knobs);

    /// Once a frame, with its time, greater than 0. Writes `knobs` and returns true when it changes level.
    bool take(double milliseconds, render::Knobs& knobs);

    [[nodiscard]] double targetMilliseconds() const { return target_; }
    [[nodiscard]] size_t level() const { return level_; }
    [[nodiscard]] size_t lowestLevel() const { return levels_.size() - 1; }
    /// The newest median; 0 before the first.
    [[nodiscard]] double milliseconds() const { return median_; }
    [[nodiscard]] bool isTargetHeld() const { return median_ <= target_; }

private:
    static constexpr uint32_t kFramesALook = 20;

    struct Level
    {
        uint32_t samples;
        render::Scale scale;
        double dearer = 1; // than the level below: times its frame, as last seen, or guessed

        [[nodiscard]] double rays() const; // relative
        [[nodiscard]] bool isWithin(const render::Knobs& knobs) const;
    };

    void look();
    void learn(double before);
    [[nodiscard]] size_t nextLevel();

    double target_;
    std::vector<Level> levels_;
    size_t level_ = 0;
    size_t seenLevel_ = 0; // that of the median
    double median_ = 0;
    std::array<double, kFramesALook> times_{};
    uint32_t frames_ = 0;
    uint32_t unsettledFrames_ = 0;
    uint32_t patience_ = 1; // looks with room before it rises
    uint32_t looksWithRoom_ = 0;
    bool hasRisen_ = false; // and not come down since
};

} // namespace antumbra::app
