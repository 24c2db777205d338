// Ray queries and compute-bvh trace the same rays: the same shadows, and nothing kept for the one that is not in use.
#include "truth/shown.h"

#include <gmock/gmock.h>

namespace antumbra::truth {
namespace {

using render::Aov;
using testing::Contains;
using testing::Field;
using testing::Not;

constexpr double kGrazing = 2e-4; // of the mean unshadowed irradiance: a ray in a hundred thousand may hit on one side only

class BackendsTest : public DeviceTest
{
protected:
    void SetUp() override
    {
        DeviceTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure() && !device().info().rayQuery)
            GTEST_SKIP() << "the device has no ray-query to compare with";
    }

    static scene::ImageF occludedBy(Shown& shown, const Backend& backend)
    {
        shown.set("occlusion.backend", backend.name);
        return shown.capture(Aov::Occluded);
    }

    void expectAgreement(const scene::SceneFile& scene)
    {
        Shown shown(device(), scene, Shown::kExtent, 0.4f);
        const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
        const double light = meanOf(shown.capture(Aov::Unshadowed), surface);
        for (const char* culling : {"none", "bones"}) {
            SCOPED_TRACE(culling);
            shown.set("occlusion.culling", culling);
            const scene::ImageF queried = occludedBy(shown, kRayQuery), walked = occludedBy(shown, kComputeBvh);
            EXPECT_GT(meanOf(queried, surface), 1e-3 * light) << "nothing casts a shadow";
            EXPECT_LT(rmse(queried, walked, surface), kGrazing * light);
        }
    }
};

TEST_F(BackendsTest, AgreeInThePlaza) { expectAgreement(namedScene("plaza")); }

TEST_F(BackendsTest, AgreeInTheHall) { expectAgreement(namedScene("hall")); }

TEST_F(BackendsTest, AgreeOnAStretchedCharacterOfOthers)
{
    const Path file = Path(ANTUMBRA_SHARED_DIR) / "assets/characters/CesiumMan.glb";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "there is no " << file.string();
    scene::SceneFile scene = scene::sceneOfModel(file, projectPath("assets") / "environments/low_sun.hdr");
    scene::Transform& transform = scene.entities.back().transform;
    transform.scale = {1.7f, 0.6f, -1.1f};
    transform.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 0.5f)));
    expectAgreement(scene);
}

TEST_F(BackendsTest, TheReferenceStartsAnewWithTheOther)
{
    Shown shown(device(), namedScene("plaza"));
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    const double light = meanOf(shown.capture(Aov::Unshadowed), surface);
    shown.set("occlusion.backend", "ray-query");
    const scene::ImageF queried = shown.reference(128);
    shown.set("occlusion.backend", "compute-bvh");
    shown.draw();
    EXPECT_LT(shown.renderer().referenceSamples(), 128u);
    EXPECT_LT(rmse(shown.reference(128), queried, surface), kGrazing * light);
}

TEST_F(BackendsTest, WhatTheOtherNeededIsGivenBack)
{
    Shown shown(device(), namedScene("hall"));
    const auto bytesWith = [&](const Backend& backend) {
        shown.set("occlusion.backend", backend.name);
        shown.draw(4 * gpu::kFramesInFlight); // what the other retired is freed
        return shown.renderer().memory().used;
    };
    const uint64_t queried = bytesWith(kRayQuery), walked = bytesWith(kComputeBvh);
    EXPECT_NE(walked, queried);
    EXPECT_EQ(bytesWith(kRayQuery), queried);
    EXPECT_EQ(bytesWith(kComputeBvh), walked);
}

TEST_F(BackendsTest, AutoIsRayQueryHere)
{
    Shown shown(device(), namedScene("plaza"));
    const scene::ImageF queried = occludedBy(shown, kRayQuery);
    shown.set("occlusion.backend", "auto");
    EXPECT_EQ(shown.capture(Aov::Occluded).values, queried.values);
    EXPECT_THAT(shown.renderer().report().absent, Not(Contains(Field(&graph::AbsentPass::name, "occlusion trace, ray-query"))));
}

} // namespace
} // namespace antumbra::truth
