// What a player with the defaults for a CPU device sees is near the truth.
#include "app/measure.h"
#include "truth/shown.h"

#include <array>

namespace antumbra::truth {
namespace {

using render::Aov;

constexpr uvec2 kScreen{640, 360}; // the error depends on it: shadows are filtered in pixels
struct Bound
{
    const char* scene;
    double error; // of the mean unshadowed irradiance
};

class DefaultsTest : public DeviceTest, public testing::WithParamInterface<Bound>
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
    Shown shown(device(), namedScene(GetParam().scene), kScreen, 0.5f);
    const app::Truth truth = truthOf(shown);
    shown.view().knobs = render::defaultKnobs(render::DeviceClass::Cpu);
    const app::ImageError error = app::errorOf(shown.capture(Aov::Irradiance), truth);
    EXPECT_LE(error.relativeRmse, GetParam().error);
    EXPECT_GE(error.ssim, 0.97);
    EXPECT_GT(error.rmse, 0) << "the truth was compared with itself";

    EXPECT_GT(app::errorOf(truth.unshadowed, truth).relativeRmse, 2 * GetParam().error) << "there is next to no shadow to get wrong";
}

// In the hall nine tenths of the squared error lie on the characters, whose folds a quarter of the resolution does not see.
INSTANTIATE_TEST_SUITE_P(Truth, DefaultsTest, testing::Values(Bound{"plaza", 0.02}, Bound{"hall", 0.02}),
                         [](const auto& test) { return std::string(test.param.scene); });

} // namespace
} // namespace antumbra::truth
