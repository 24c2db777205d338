// Area light that is found for some pixels: none of it crosses an edge, and it is the same whoever upsamples it.
#include "truth/shown.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace antumbra::truth {
namespace {

using render::Aov;
using testing::Contains;
using testing::Not;

class AreaUpsampling : public DeviceTest, public testing::WithParamInterface<const char*>
{
protected:
    static scene::ImageF capturedAt(Shown& shown, const char* scale, Aov aov)
    {
        shown.set("area.scale", scale);
        return shown.capture(aov);
    }
};

TEST_P(AreaUpsampling, MixesNothingAcrossADepthEdge)
{
    scene::SceneFile scene = darkScene(); // a block whose top is bright before a floor that it shades
    scene.camera.position = {0, 4, 2.5f};
    scene.entities.push_back(lampAt({4, 6, 0}, vec3(500)));
    scene.entities.push_back(blocker({0, 0.4f, 0}, {1.6f, 0.8f, 1.2f}));
    Shown shown(device(), scene);
    const std::vector<size_t> top = pixelsAtHeight(shown, 0.8f);
    ASSERT_GT(top.size(), 100u);
    const scene::ImageF all = capturedAt(shown, "1", Aov::Irradiance), some = capturedAt(shown, GetParam(), Aov::Irradiance);
    size_t mixed = 0;
    for (const size_t pixel : top)
        mixed += std::abs(pixelOf(some, pixel).y - pixelOf(all, pixel).y) > 0.05f * pixelOf(all, pixel).y ? 1 : 0;
    // At a corner none of the coarse pixels around may lie on it.
    EXPECT_LE(mixed, top.size() / 50);
    EXPECT_GT(rmse(some, all, top), 0) << "all of it was found";
    const double bright = meanOf(all, top);
    const std::vector<size_t> floor = pixelsAtHeight(shown, 0);
    EXPECT_TRUE(std::ranges::any_of(floor, [&](size_t pixel) { return pixelOf(all, pixel).y < 0.1 * bright; })) << "nothing dark";
}

TEST_P(AreaUpsampling, IsTheSameWhateverElseIsTraced)
{
    // Below a glossy floor something moves, so that occlusion is traced, and hides nothing.
    scene::SceneFile scene = emptyScene();
    scene.entities = {staticShape(scene::MeshKind::Plane, {0, 0, 0}, {4, 1, 4}), lampAt({0, 1.5f, 0}), blocker({0, 0.4f, 0}, vec3(0.5f)),
                      movingShape(scene::MeshKind::Sphere, {0, -2, 0}, vec3(0.5f))};
    scene.entities[0].material = scene::Material{.albedo = vec3(0.5f), .roughness = 0.4f, .metallic = 0.5f};
    Shown shown(device(), scene);
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    shown.set("occlusion.scale", GetParam());
    const scene::ImageF together = capturedAt(shown, GetParam(), Aov::Color);
    EXPECT_THAT(stepsOf(shown), Not(Contains("area upsample")));
    shown.set("occlusion.scale", "1");
    const scene::ImageF apart = capturedAt(shown, GetParam(), Aov::Color);
    EXPECT_THAT(stepsOf(shown), Contains("area upsample"));
    EXPECT_LT(rmse(together, apart, surface), 1e-3 * meanOf(apart, surface));
    EXPECT_GT(rmse(capturedAt(shown, "1", Aov::Color), apart, surface), 1e-3 * meanOf(apart, surface)) << "all of it was found";
}

INSTANTIATE_TEST_SUITE_P(Truth, AreaUpsampling, testing::Values("1/2", "1/4"));

} // namespace
} // namespace antumbra::truth
