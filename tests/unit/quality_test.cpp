// Quality under a target frame time: down while frames are too long, up again when there is room, never above the start.
#include "app/quality.h"

#include <gtest/gtest.h>

namespace antumbra::app {
namespace {

render::Knobs startKnobs()
{
    render::Knobs knobs;
    knobs.occlusion.samples = 128;
    knobs.occlusion.scale = render::Scale::Full;
    return knobs;
}

/// As a frame would cost whose time is all in the occlusion pass.
double cost(const render::Knobs& knobs)
{
    const auto edge = static_cast<double>(knobs.occlusion.scale);
    return 40.0 * knobs.occlusion.samples / 128 / (edge * edge);
}

void run(QualityControl& quality, render::Knobs& knobs, int frames)
{
    for (int frame = 0; frame < frames; ++frame)
        quality.take(cost(knobs), knobs);
}

TEST(Quality, ComesDownUntilTheTargetIsHeldAndStays)
{
    render::Knobs knobs = startKnobs();
    QualityControl quality(25, knobs);
    run(quality, knobs, 100);
    EXPECT_LE(cost(knobs), 25);
    const uint32_t settled = knobs.occlusion.samples;
    run(quality, knobs, 400);
    EXPECT_EQ(knobs.occlusion.samples, settled);
}

TEST(Quality, EndsAtTheCheapestWhereNothingHelps)
{
    render::Knobs knobs = startKnobs();
    QualityControl quality(0.001, knobs);
    run(quality, knobs, 1000);
    EXPECT_EQ(knobs.occlusion.samples, 32u);
    EXPECT_EQ(knobs.occlusion.scale, render::Scale::Quarter);
}

TEST(Quality, RisesAgainButNeverAboveTheStart)
{
    render::Knobs knobs = startKnobs();
    QualityControl quality(25, knobs);
    run(quality, knobs, 200);
    for (int frame = 0; frame < 1000; ++frame)
        quality.take(0.1, knobs);
    EXPECT_EQ(knobs.occlusion.samples, 128u);
    EXPECT_EQ(knobs.occlusion.scale, render::Scale::Full);
}

TEST(Quality, SamplesStayMultiplesOf32)
{
    render::Knobs knobs = startKnobs();
    knobs.occlusion.samples = 352;
    QualityControl quality(0.001, knobs);
    for (int frame = 0; frame < 1000; ++frame) {
        run(quality, knobs, 1);
        ASSERT_EQ(knobs.occlusion.samples % 32, 0u);
    }
}

} // namespace
} // namespace antumbra::app
