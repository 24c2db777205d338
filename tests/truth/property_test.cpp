// What holds for every right shadow: bounds, monotony, symmetry, and that a wall hides what is behind it.
#include "truth/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace antumbra::truth {
namespace {

using render::Aov;
using scene::MeshKind;

class PropertyTest : public DeviceTest
{
};

class BlockingTest : public BackendTest<Backend>
{
};

TEST_F(PropertyTest, IrradianceIsNeverNegativeAndNeverMoreThanUnshadowed)
{
    for (const char* name : {"plaza", "hall", "crowd"})
        for (const char* scale : {"1", "1/4"}) {
            SCOPED_TRACE(fmt::format("{} at {}", name, scale));
            Shown shown(device(), namedScene(name), Shown::kExtent, 0.3f);
            shown.set("occlusion.scale", scale);
            shown.set("occlusion.filter", "5");
            shown.set("occlusion.samples", "32"); // noise tries hardest
            const scene::ImageF irradiance = shown.capture(Aov::Irradiance), unshadowed = shown.capture(Aov::Unshadowed);
            size_t wrong = 0;
            for (size_t i = 0; i < irradiance.values.size(); ++i)
                wrong += irradiance.values[i] >= 0 && irradiance.values[i] <= std::max(unshadowed.values[i], 0.0f) ? 0 : 1;
            EXPECT_EQ(wrong, 0u);
            const shader::CounterBlock counters = shown.counters();
            EXPECT_EQ(counters.nanPixels + counters.infPixels, 0u);
        }
}

/// Two walkers on a plane, or the first alone, in uniform light.
scene::SceneFile walkers(size_t count)
{
    scene::SceneFile scene = emptyScene();
    scene.entities = {staticShape(MeshKind::Plane, {0, 0, 0}, {8, 1, 8}), walker({-0.5f, 0, 0}, "walk"), walker({0.5f, 0, 0.3f}, "wave")};
    scene.entities.resize(1 + count);
    return scene;
}

TEST_F(PropertyTest, AnotherCharacterNeverBrightens)
{
    Shown one(device(), walkers(1)), two(device(), walkers(2));
    const scene::ImageF depthOne = one.capture(Aov::Depth), depthTwo = two.capture(Aov::Depth);
    for (const char* culling : {"none", "length", "bones"}) {
        SCOPED_TRACE(culling);
        one.set("occlusion.culling", culling);
        two.set("occlusion.culling", culling);
        const scene::ImageF litByOne = one.capture(Aov::Irradiance), litByTwo = two.capture(Aov::Irradiance);
        size_t brighter = 0, darker = 0;
        for (const size_t pixel : surfaceOf(depthOne)) {
            if (depthOne.values[pixel] != depthTwo.values[pixel])
                continue; // the newcomer is in front
            const float before = pixelOf(litByOne, pixel).y, after = pixelOf(litByTwo, pixel).y;
            brighter += after > before + 2e-3f ? 1 : 0; // a step of a half float near pi
            darker += after < before - 0.02f ? 1 : 0;
        }
        EXPECT_EQ(brighter, 0u);
        EXPECT_GT(darker, 100u) << "the newcomer casts no shadow";
    }
}

void turn(scene::SceneFile& scene, float radians)
{
    const quat rotation = glm::angleAxis(radians, vec3(0, 1, 0));
    scene.camera.position = rotation * scene.camera.position;
    scene.camera.target = rotation * scene.camera.target;
    scene.environment->rotationRadians += radians;
    for (scene::SceneEntity& entity : scene.entities) {
        entity.transform.position = rotation * entity.transform.position;
        entity.transform.rotation = rotation * entity.transform.rotation;
    }
}

TEST_F(PropertyTest, TurningWorldAndLightTogetherChangesNothing)
{
    scene::SceneFile scene = namedScene("plaza");
    Shown straight(device(), scene, Shown::kExtent, 0.3f);
    turn(scene, 1.1f);
    Shown turned(device(), scene, Shown::kExtent, 0.3f);
    const scene::ImageF depth = straight.capture(Aov::Depth), depthTurned = turned.capture(Aov::Depth);
    std::vector<size_t> surface = surfaceOf(depth);
    // Rounding moves an outline by a pixel here and there.
    const size_t all = surface.size();
    std::erase_if(surface,
                  [&](size_t pixel) { return std::abs(depthTurned.values[pixel] - depth.values[pixel]) > 1e-3f * depth.values[pixel]; });
    ASSERT_GT(surface.size(), all * 98 / 100);
    const scene::ImageF unshadowed = straight.capture(Aov::Unshadowed);
    const double light = meanOf(unshadowed, surface);
    EXPECT_LT(rmse(turned.capture(Aov::Unshadowed), unshadowed, surface) / light, 2e-3);
    EXPECT_LT(rmse(turned.reference(1024), straight.reference(1024), surface) / light, 0.02);
    // The light alone makes another picture: the comparison above can fail.
    turned.view().environment.rotationRadians += 1.1f;
    EXPECT_GT(rmse(turned.capture(Aov::Unshadowed), unshadowed, surface) / light, 0.03);
}

TEST_P(BlockingTest, ADynamicObjectInAClosedStaticBoxCastsNothing)
{
    scene::SceneFile scene = emptyScene();
    scene.entities = {staticShape(MeshKind::Plane, {0, 0, 0}, {6, 1, 6}), movingShape(MeshKind::Sphere, {0, 0.6f, 0}, vec3(0.9f)),
                      staticShape(MeshKind::Cube, {0, 0.6f, 0}, vec3(1.1f))};
    Shown boxed(device(), scene);
    boxed.set("occlusion.backend", backend().name);
    scene.entities.pop_back();
    Shown open(device(), scene);
    open.set("occlusion.backend", backend().name);
    for (const char* culling : {"none", "direction", "length", "bones"}) {
        SCOPED_TRACE(culling);
        boxed.set("occlusion.culling", culling);
        open.set("occlusion.culling", culling);
        EXPECT_EQ(std::ranges::max(boxed.capture(Aov::Occluded).values), 0.0f);
        EXPECT_GT(std::ranges::max(open.capture(Aov::Occluded).values), 1.0f);
    }
}

/// On the floor; x = 0 parts left from right.
void expectShadowOnTheRightAlone(Shown& shown)
{
    const scene::ImageF depth = shown.capture(Aov::Depth), occluded = shown.capture(Aov::Occluded);
    float greatestLeft = 0, greatestRight = 0;
    for (const size_t pixel : surfaceOf(depth)) {
        const vec3 position =
            positionAt(shown.view().camera, Shown::kExtent, {pixel % Shown::kExtent.x, pixel / Shown::kExtent.x}, depth.values[pixel]);
        if (std::abs(position.y) > 1e-2f)
            continue;
        float& greatest = position.x < 0 ? greatestLeft : greatestRight;
        greatest = std::max(greatest, pixelOf(occluded, pixel).y);
    }
    EXPECT_EQ(greatestLeft, 0.0f);
    EXPECT_GT(greatestRight, 1.0f);
}

TEST_P(BlockingTest, AWallHidesADynamicObjectFromItsOtherSideOnly)
{
    // The wall stands at x = 0, the sphere on its right; uniform light comes from above as well, so the left is lit but never darkened.
    scene::SceneFile scene = emptyScene();
    scene.camera.position = {0, 6, 0.1f};
    scene.camera.target = {0, 0, 0};
    for (const scene::SceneEntity& sphere : {movingShape(MeshKind::Sphere, {1, 0.5f, 0}, vec3(1)), fieldBall({1, 0.5f, 0}, 0.5f)})
        for (const char* culling : {"none", "bones"}) {
            scene.entities = {staticShape(MeshKind::Plane, {0, 0, 0}, {6, 1, 6}), staticShape(MeshKind::Cube, {0, 1, 0}, {0.1f, 2, 20}),
                              sphere};
            Shown shown(device(), scene);
            shown.set("occlusion.backend", backend().name);
            shown.set("occlusion.culling", culling);
            expectShadowOnTheRightAlone(shown);
        }
}

INSTANTIATE_TEST_SUITE_P(Truth, BlockingTest, testing::Values(kRayQuery, kComputeBvh), backendName);

} // namespace
} // namespace antumbra::truth
