// Characters that are capsules to area lights: how near their shadows come, and who goes by them.
#include "truth/shown.h"

#include <gmock/gmock.h>

namespace antumbra::truth {
namespace {

using render::Aov;
using scene::ImageF;
using scene::LightShadow;
using testing::Contains;
using testing::Not;

class BoneShadows : public DeviceTest
{
protected:
    static constexpr uvec2 kExtent{160, 90};

    static scene::SceneEntity lamp(vec3 position, LightShadow shadow)
    {
        scene::SceneEntity lamp = lampAt(position);
        lamp.areaLight->shadow = shadow;
        return lamp;
    }

    static scene::SceneEntity walkerOfBones()
    {
        scene::SceneEntity character = walker({0, 0, 0}, "walk");
        character.sdfPrimitive = scene::SDFPrimitive{.shape = scene::SDFShape::Bones};
        return character;
    }

    static scene::SceneFile sceneOf(const scene::SceneEntity& character, const std::vector<scene::SceneEntity>& lamps)
    {
        scene::SceneFile scene = darkScene();
        scene.camera = {.position = {1.5f, 2, 3}, .target = {0, 0.7f, 0}};
        scene.entities.push_back(character);
        scene.entities.insert(scene.entities.end(), lamps.begin(), lamps.end());
        return scene;
    }

    struct Lit
    {
        ImageF irradiance, depth;
    };
    Lit lit(const scene::SceneFile& scene)
    {
        Shown shown(device(), scene, kExtent, 0.3f);
        shown.set("area.scale", "1");
        shown.set("reference.samples", "256");
        do
            shown.draw();
        while (shown.renderer().referenceSamples().value_or(256) < 256);
        Lit made{shown.capture(Aov::Irradiance), shown.capture(Aov::Depth)};
        const shader::CounterBlock counters = shown.counters();
        EXPECT_EQ(counters.nanPixels + counters.infPixels + counters.negativePixels, 0u);
        return made;
    }
};

const vec3 kAbove{-0.8f, 2.6f, 0.5f}, kBeside{1.4f, 2.2f, 0.8f};

TEST_F(BoneShadows, AreNearThoseOfTheMesh)
{
    const Lit truth = lit(sceneOf(walker({0, 0, 0}, "walk"), {lamp(kAbove, LightShadow::Reference)}));
    const std::vector<size_t> surface = surfaceOf(truth.depth);
    const double light = meanOf(truth.irradiance, surface);
    const Lit open = lit(sceneOf(walker({0, 0, 0}, "walk"), {lamp(kAbove, LightShadow::Analytic)})),
              bones = lit(sceneOf(walkerOfBones(), {lamp(kAbove, LightShadow::Analytic)}));
    const double without = rmse(open.irradiance, truth.irradiance, surface) / light,
                 with = rmse(bones.irradiance, truth.irradiance, surface) / light;
    RecordProperty("without", std::to_string(without));
    RecordProperty("with", std::to_string(with));
    EXPECT_LT(with, 0.05);
    EXPECT_GT(without, 4 * with);
    EXPECT_EQ(bones.depth.values, open.depth.values) << "bones are seen";
}

// Rays meet the mesh: what stands for it hides nothing from them a second time.
TEST_F(BoneShadows, HideNoLightThatMeetsTheMesh)
{
    for (const LightShadow shadow : {LightShadow::Ratio, LightShadow::TwoSided, LightShadow::Traced}) {
        const scene::SceneEntity rays = lamp(kAbove, shadow), cones = lamp(kBeside, LightShadow::Analytic);
        const Lit mesh = lit(sceneOf(walker({0, 0, 0}, "walk"), {rays})), bones = lit(sceneOf(walkerOfBones(), {rays})),
                  beside = lit(sceneOf(walkerOfBones(), {cones})), both = lit(sceneOf(walkerOfBones(), {rays, cones}));
        EXPECT_EQ(mesh.irradiance.values, bones.irradiance.values);
        const std::vector<size_t> surface = surfaceOf(both.depth);
        ImageF sum = mesh.irradiance;
        for (size_t i = 0; i < sum.values.size(); ++i)
            sum.values[i] += beside.irradiance.values[i];
        // Their noise is another where there are two lights.
        EXPECT_NEAR(meanOf(both.irradiance, surface), meanOf(sum, surface), 0.001 * meanOf(sum, surface));
    }
}

TEST_F(BoneShadows, AreNotMadeWhereNoLightAsks)
{
    Shown shown(device(), sceneOf(walkerOfBones(), {lampAt(kAbove)}));
    shown.draw();
    EXPECT_THAT(stepsOf(shown), Contains("sdf shadow"));
    shown.set("sdf.shadow", "none");
    shown.draw();
    EXPECT_THAT(stepsOf(shown), Not(Contains("sdf shadow")));
    shown.set("sdf.shadow", "sub-cones");
    shown.set("area.shadow", "traced");
    shown.draw();
    EXPECT_THAT(stepsOf(shown), Not(Contains("sdf shadow")));
}

} // namespace
} // namespace antumbra::truth
