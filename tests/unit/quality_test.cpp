// Quality under a target frame time: down while frames are too long, up again when there is room, never above the start.
#include "app/quality.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antumbra::app {
namespace {

render::Knobs startKnobs()
{
    render::Knobs knobs;
    knobs.occlusion.samples = 128;
    knobs.occlusion.scale = render::Scale::Full;
    return knobs;
}

/// A frame whose time is `fixed` plus what its rays take.
struct Machine
{
    double fixed = 0;
    double raysAtStart = 40;
    double noise = 0; // share
    double frames = 0;

    double frame(const render::Knobs& knobs)
    {
        const auto edge = static_cast<double>(knobs.occlusion.scale);
        const double swing = std::sin(12.9898 * ++frames); // never the same twice, the same in every run
        return (fixed + raysAtStart * knobs.occlusion.samples / 128 / (edge * edge)) * (1 + noise * swing);
    }
};

/// Returns how often the level changed.
int run(QualityControl& quality, render::Knobs& knobs, Machine machine, int frames)
{
    int changes = 0;
    for (int frame = 0; frame < frames; ++frame)
        changes += quality.take(machine.frame(knobs), knobs) ? 1 : 0;
    return changes;
}

TEST(Quality, ComesDownUntilTheTargetIsHeldAndStays)
{
    for (const double fixed : {0.0, 3.0, 8.0})
        for (double target = 9; target < 60; target += 0.5) {
            render::Knobs knobs = startKnobs();
            QualityControl quality(target, knobs, knobs);
            run(quality, knobs, {.fixed = fixed}, 200);
            EXPECT_LE(Machine{.fixed = fixed}.frame(knobs), target);
            EXPECT_TRUE(quality.isTargetHeld());
            EXPECT_EQ(run(quality, knobs, {.fixed = fixed}, 1000), 0) << fixed << " ms and a target of " << target;
        }
}

TEST(Quality, NoiseMovesItSeldomAndEverLess)
{
    for (double target = 9; target < 60; target += 0.5) {
        render::Knobs knobs = startKnobs();
        QualityControl quality(target, knobs, knobs);
        run(quality, knobs, {.fixed = 3, .noise = 0.4}, 4000);
        EXPECT_LE(run(quality, knobs, {.fixed = 3, .noise = 0.4}, 4000), 2) << target;
    }
}

TEST(Quality, ASingleSlowFrameChangesNothing)
{
    render::Knobs knobs = startKnobs();
    QualityControl quality(50, knobs, knobs);
    for (int frame = 0; frame < 400; ++frame)
        EXPECT_FALSE(quality.take(frame % 20 == 0 ? 5000 : 40, knobs));
}

TEST(Quality, RisesWhenTheMachineIsFreeAgainThoughItWasSlowOnTheWayDown)
{
    render::Knobs knobs = startKnobs();
    QualityControl quality(20, knobs, knobs);
    run(quality, knobs, {.raysAtStart = 400}, 300);
    EXPECT_EQ(knobs.occlusion.scale, render::Scale::Quarter);
    run(quality, knobs, {.raysAtStart = 16}, 300);
    EXPECT_EQ(quality.level(), 0u);
}

TEST(Quality, BeginsWhereTheKnobsAreAndRisesToWhatFits)
{
    for (const double fixed : {0.0, 3.0, 8.0})
        for (double target = 9; target < 60; target += 0.5) {
            render::Knobs knobs = startKnobs();
            knobs.occlusion.samples = 32;
            knobs.occlusion.scale = render::Scale::Quarter;
            QualityControl quality(target, startKnobs(), knobs);
            EXPECT_EQ(quality.level(), quality.lowestLevel());
            run(quality, knobs, {.fixed = fixed}, 3000);
            const double settled = Machine{.fixed = fixed}.frame(knobs);
            EXPECT_LE(settled, target);
            EXPECT_LE(run(quality, knobs, {.fixed = fixed}, 1000), 0) << fixed << " ms and a target of " << target;
            EXPECT_TRUE(quality.level() == 0 || 4 * settled > 0.9 * target) << "four times its time would have fitted " << target;
        }
}

TEST(Quality, EndsAtTheCheapestWhereNothingHelps)
{
    render::Knobs knobs = startKnobs();
    QualityControl quality(0.001, knobs, knobs);
    run(quality, knobs, {}, 1000);
    EXPECT_EQ(knobs.occlusion.samples, 32u);
    EXPECT_EQ(knobs.occlusion.scale, render::Scale::Quarter);
    EXPECT_EQ(quality.level(), quality.lowestLevel());
    EXPECT_FALSE(quality.isTargetHeld());
}

TEST(Quality, RisesAgainButNeverAboveTheStart)
{
    render::Knobs knobs = startKnobs();
    QualityControl quality(25, knobs, knobs);
    run(quality, knobs, {}, 200);
    for (int frame = 0; frame < 1000; ++frame)
        quality.take(0.1, knobs);
    EXPECT_EQ(knobs.occlusion.samples, 128u);
    EXPECT_EQ(knobs.occlusion.scale, render::Scale::Full);
}

TEST(Quality, SamplesStayMultiplesOf32)
{
    render::Knobs knobs = startKnobs();
    knobs.occlusion.samples = 352;
    QualityControl quality(0.001, knobs, knobs);
    for (int frame = 0; frame < 1000; ++frame) {
        run(quality, knobs, {}, 1);
        ASSERT_EQ(knobs.occlusion.samples % 32, 0u);
    }
}

} // namespace
} // namespace antumbra::app
