// Steady frames, from input to submission, take nothing from the heap and nothing from the device's memory.
#include "app/playback.h"
#include "base/error.h"
#include "game/gameplay.h"
#include "unit/allocation_counter.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace antumbra::app {
namespace {

constexpr int kWarmFrames = 120; // long enough for every clip of the walk to have come round
constexpr int kSteadyFrames = 300;

// Without the validation layer, whose own bookkeeping would be counted.
std::unique_ptr<gpu::Device> makeDevice()
{
    try {
        return std::make_unique<gpu::Device>(gpu::DeviceOptions{});
    } catch (const Error&) {
        return nullptr;
    }
}

void walk(Playback& playback, int frames)
{
    ScriptStep walking;
    walking.input.move = {0, 1};
    for (int frame = 0; frame < frames; ++frame) {
        playback.perform(walking);
        playback.draw(kStepSeconds, nullptr, nullptr);
        playback.measure(1);
    }
}

class SteadyTest : public testing::TestWithParam<std::tuple<const char*, bool>>
{
};

TEST_P(SteadyTest, AllocatesNothingOnHeapOrDevice)
{
    const std::unique_ptr<gpu::Device> device = makeDevice();
    if (!device) {
        ASSERT_EQ(std::getenv("ANTUMBRA_REQUIRE_DEVICE"), nullptr) << "no Vulkan device";
        GTEST_SKIP() << "no Vulkan device";
    }
    const auto& [scene, showsOverlay] = GetParam();
    Stage stage(findScene(scene, {}), 1, game::addGameplay);
    Playback playback(*device, stage, {.sceneName = scene, .size = uvec2(64, 36), .showsOverlay = showsOverlay});
    playback.warmUp();
    walk(playback, kWarmFrames);
    const uint64_t heap = test::allocationCount();
    const uint64_t deviceRanges = playback.renderer().memory().allocationsEver;
    walk(playback, kSteadyFrames);
    EXPECT_EQ(test::allocationCount() - heap, 0u);
    EXPECT_EQ(playback.renderer().memory().allocationsEver - deviceRanges, 0u);
}

std::string nameOf(const testing::TestParamInfo<SteadyTest::ParamType>& test)
{
    const auto& [scene, showsOverlay] = test.param;
    return std::string(scene) + (showsOverlay ? "WithOverlay" : "WithoutOverlay");
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutOverlay, SteadyTest, testing::Combine(testing::Values("plaza", "stage", "garden"), testing::Bool()), nameOf);

} // namespace
} // namespace antumbra::app
