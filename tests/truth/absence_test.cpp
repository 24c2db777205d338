// Off means off: what a scene does not call for takes no pass and no memory.
#include "truth/shown.h"

#include <gmock/gmock.h>

namespace antumbra::truth {
namespace {

using scene::MeshKind;
using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;

const std::vector<std::string> kPassesOfMotion{"skinning", "triangle builds", "scene build",
                                               "bounds",   "occlusion trace", "occlusion filter"};

class AbsenceTest : public BackendTest<Backend>
{
};

/// The scene with all of it at rest.
scene::SceneFile atRest(scene::SceneFile scene)
{
    for (scene::SceneEntity& entity : scene.entities) {
        entity.isDynamicSkinned = false;
        entity.animation.reset();
    }
    return scene;
}

TEST_P(AbsenceTest, WithoutDynamicSkinnedNothingIsPosedTracedOrFiltered)
{
    Shown still(device(), atRest(namedScene("plaza")));
    still.set("occlusion.backend", backend().name);
    still.set("occlusion.filter", "5");
    still.set("occlusion.scale", "1/2");
    still.draw();
    std::vector<std::string> absent;
    for (const graph::AbsentPass& pass : still.renderer().report().absent) {
        absent.emplace_back(pass.name);
        if (std::ranges::find(kPassesOfMotion, absent.back()) != kPassesOfMotion.end()) {
            EXPECT_EQ(pass.reason, "no DynamicSkinned in the scene");
        }
    }
    EXPECT_THAT(absent, IsSupersetOf(kPassesOfMotion));
    for (const std::string& pass : kPassesOfMotion)
        EXPECT_THAT(stepsOf(still), Not(Contains(pass)));

    Shown moving(device(), namedScene("plaza"));
    moving.set("occlusion.backend", backend().name);
    moving.set("occlusion.filter", "5");
    moving.set("occlusion.scale", "1/2");
    moving.draw();
    EXPECT_THAT(stepsOf(moving), IsSupersetOf(kPassesOfMotion)) << "the same scene in motion has them all";
}

/// Device bytes that the scene takes once it runs steadily, whatever stood on the device before.
uint64_t bytesOf(gpu::Device& device, const Backend& backend, const scene::SceneFile& scene, const char* samples)
{
    const uint64_t before = settledBytes(device);
    Shown shown(device, scene);
    shown.set("occlusion.backend", backend.name);
    shown.set("occlusion.samples", samples);
    shown.set("occlusion.culling", "bones");
    shown.draw(8);
    return shown.renderer().memory().used - before;
}

TEST_P(AbsenceTest, WithoutDynamicSkinnedOcclusionTakesNoMemory)
{
    const scene::SceneFile plaza = namedScene("plaza");
    bytesOf(device(), backend(), plaza, "1024"); // grows the device's own stores to what any of these needs
    const uint64_t still = bytesOf(device(), backend(), atRest(plaza), "64");
    EXPECT_EQ(bytesOf(device(), backend(), atRest(plaza), "1024"), still) << "samples and masks are made for nobody";
    EXPECT_GT(bytesOf(device(), backend(), plaza, "64"), still + (uint64_t{1} << 17)) << "masks alone are more";

    scene::SceneFile empty = emptyScene();
    empty.entities = {staticShape(MeshKind::Plane, {0, 0, 0}, vec3(4))};
    scene::SceneFile sphere = empty;
    sphere.entities.push_back(movingShape(MeshKind::Sphere, {0, 0.5f, 0}, vec3(1)));
    EXPECT_GT(bytesOf(device(), backend(), sphere, "64"), bytesOf(device(), backend(), empty, "64"));
}

TEST_P(AbsenceTest, WhatLeavesTheSceneTakesItsPassesAlong)
{
    Shown shown(device(), namedScene("plaza"));
    shown.set("occlusion.backend", backend().name);
    shown.draw(4);
    EXPECT_THAT(stepsOf(shown), Contains("occlusion trace"));
    shown.view().characters.clear();
    shown.draw(4);
    for (const std::string& pass : kPassesOfMotion)
        EXPECT_THAT(stepsOf(shown), Not(Contains(pass)));
}

TEST_P(AbsenceTest, APoseThatDidNotChangeIsNotBuiltAgain)
{
    Shown shown(device(), namedScene("plaza"));
    shown.set("occlusion.backend", backend().name);
    shown.draw(2);
    EXPECT_THAT(stepsOf(shown), Not(Contains("triangle builds")));
    EXPECT_THAT(stepsOf(shown), Not(Contains("skinning")));
    shown.advance(0.1f);
    shown.draw();
    EXPECT_THAT(stepsOf(shown), Contains("triangle builds"));
}

INSTANTIATE_TEST_SUITE_P(Truth, AbsenceTest, testing::Values(kRayQuery, kComputeBvh), backendName);

} // namespace
} // namespace antumbra::truth
