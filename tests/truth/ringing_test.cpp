// A strong sun in few bands of harmonics rings: behind what hides it there would be less than no light. It is clamped, and counted.
#include "truth/shown.h"

namespace antumbra::truth {
namespace {

using render::Aov;

class RingingTest : public DeviceTest, public testing::WithParamInterface<const char*>
{
};

TEST_P(RingingTest, IsClampedAndCountedInPixelsOfThePicture)
{
    Shown shown(device(), namedScene("plaza"));
    shown.set("occlusion.scale", GetParam());
    const scene::ImageF occluded = shown.capture(Aov::Occluded), irradiance = shown.capture(Aov::Irradiance),
                        unshadowed = shown.capture(Aov::Unshadowed);
    for (size_t i = 0; i < irradiance.values.size(); ++i) {
        ASSERT_GE(occluded.values[i], 0);
        ASSERT_LE(irradiance.values[i], unshadowed.values[i]) << "nothing is lighter for what stands before the sky";
    }
    const uint32_t clamped = shown.counters().clampedPixels;
    EXPECT_GT(clamped, 100u);
    EXPECT_LT(clamped, Shown::kExtent.x * Shown::kExtent.y / 2);
}

TEST_P(RingingTest, LightWithoutASunHasNone)
{
    scene::SceneFile plaza = namedScene("plaza");
    plaza.environment->file.clear(); // uniform
    Shown shown(device(), plaza);
    shown.set("occlusion.scale", GetParam());
    EXPECT_EQ(shown.counters().clampedPixels, 0u);
}

INSTANTIATE_TEST_SUITE_P(Truth, RingingTest, testing::Values("1", "1/4"));

} // namespace
} // namespace antumbra::truth
