// What a player with the defaults for a CPU device sees is near the truth.
#include "app/measure.h"
#include "truth/shown.h"

#include <array>

namespace antumbra::truth {
namespace {

using render::Aov;

constexpr uvec2 kScreen{640, 360}; // the error depends on it: shadows are filtered in pixels
// Of the mean unshadowed irradiance.
constexpr double kGreatestError = 0.02;

class DefaultsTest : public DeviceTest, public testing::WithParamInterface<const char*>
{
};

/// As many samples as there can be, unfiltered. Culling them is tested to change nothing, and the reference takes minutes at this size.
app::Truth truthOf(Shown& shown)
{
    shown.set("occlusion.samples", "1024");
    shown.set("occlusion.culling", "bones");
    render::Renderer& renderer = shown.renderer();
    constexpr std::array aovs{Aov::Irradiance, Aov::Unshadowed, Aov::Depth};
    renderer.capture(aovs); // all from one frame: they are slow
    shown.draw();
    return {.irradiance = renderer.captured(Aov::Irradiance),
            .unshadowed = renderer.captured(Aov::Unshadowed),
            .depth = renderer.captured(Aov::Depth)};
}

TEST_P(DefaultsTest, AreNearTheTruth)
{
    Shown shown(device(), namedScene(GetParam()), kScreen, 0.5f);
    const app::Truth truth = truthOf(shown);
    shown.view().knobs = render::defaultKnobs(render::DeviceClass::Cpu);
    const app::ImageError error = app::errorOf(shown.capture(Aov::Irradiance), truth);
    EXPECT_LE(error.relativeRmse, kGreatestError);
    EXPECT_GE(error.ssim, 0.97);
    EXPECT_GT(error.rmse, 0) << "the truth was compared with itself";

    EXPECT_GT(app::errorOf(truth.unshadowed, truth).relativeRmse, 2 * kGreatestError) << "there is next to no shadow to get wrong";
}

INSTANTIATE_TEST_SUITE_P(Truth, DefaultsTest, testing::Values("plaza", "hall"), [](const auto& test) { return std::string(test.param); });

} // namespace
} // namespace antumbra::truth
