// The filter and the upsampling leave a constant alone and mix nothing across an edge.
#include "truth/shown.h"

#include <algorithm>
#include <cmath>

namespace antumbra::truth {
namespace {

using render::Aov;
using scene::MeshKind;

struct Setting
{
    const char* scale;
    const char* filter;

    friend void PrintTo(const Setting& setting, std::ostream* out) { *out << "scale " << setting.scale << ", filter " << setting.filter; }
};

class FilterTest : public DeviceTest, public testing::WithParamInterface<Setting>
{
protected:
    static void configure(Shown& shown)
    {
        shown.set("occlusion.scale", GetParam().scale);
        shown.set("occlusion.filter", GetParam().filter);
    }
};

TEST_P(FilterTest, KeepsAConstant)
{
    // Under a moving dome, whose inside is not drawn, every ray of the floor is stopped; the sky beside it has no occlusion to give.
    scene::SceneFile scene = emptyScene();
    scene.entities = {staticShape(MeshKind::Plane, {0, 0, 0}, vec3(3.5f)), movingShape(MeshKind::Sphere, {0, 0, 0}, vec3(12))};
    Shown inside(device(), scene);
    configure(inside);
    const std::vector<size_t> floor = pixelsAtHeight(inside, 0);
    ASSERT_GT(floor.size(), 1000u);
    ASSERT_LT(floor.size(), size_t{Shown::kExtent.x} * Shown::kExtent.y - 1000) << "no edge in view";
    const scene::ImageF occluded = inside.capture(Aov::Occluded);
    for (const size_t pixel : floor)
        ASSERT_NEAR(pixelOf(occluded, pixel).y, kPi, 4e-3f) << pixel % Shown::kExtent.x << ' ' << pixel / Shown::kExtent.x;
}

TEST_P(FilterTest, MixesNothingAcrossADepthEdge)
{
    // Nothing is above the table, so nothing may darken it, however dark the floor beside its edges.
    scene::SceneFile scene = emptyScene();
    scene.camera = {.position = {0, 4, 2.5f}, .target = {0, 0.5f, 0}, .verticalFovRadians = glm::radians(40.0f)};
    scene.entities = {staticShape(MeshKind::Plane, {0, 0, 0}, vec3(20)), staticShape(MeshKind::Plane, {0, 1, 0}, {1.4f, 1, 1.4f}),
                      movingShape(MeshKind::Sphere, {1.15f, 0.45f, 0}, vec3(0.9f))};
    Shown above(device(), scene);
    configure(above);
    const std::vector<size_t> table = pixelsAtHeight(above, 1);
    ASSERT_GT(table.size(), 500u);
    const scene::ImageF occluded = above.capture(Aov::Occluded);
    ASSERT_GT(std::ranges::max(occluded.values), 0.5f) << "nothing dark to bleed";
    size_t darkened = 0;
    for (const size_t pixel : table)
        darkened += pixelOf(occluded, pixel).y > 2e-3f * kPi ? 1 : 0;
    // At a corner of the table none of the coarse pixels around may lie on it.
    EXPECT_LE(darkened, std::string(GetParam().scale) == "1" ? 0 : table.size() / 200);
}

INSTANTIATE_TEST_SUITE_P(Truth, FilterTest,
                         testing::Values(Setting{"1", "0"}, Setting{"1", "3"}, Setting{"1", "5"}, Setting{"1", "9"}, Setting{"1/2", "0"},
                                         Setting{"1/2", "5"}, Setting{"1/4", "0"}, Setting{"1/4", "5"}));

} // namespace
} // namespace antumbra::truth
