// Shadows that are a share of the whole light, found by few rays: the ratio of denoised terms, and penumbras from one ray a pixel.
#include "truth/shown.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace antumbra::truth {
namespace {

using render::Aov;
using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;

constexpr const char* kShares[] = {"ratio", "article", "two-sided"};

scene::ImageF irradianceBy(Shown& shown, const char* shadow)
{
    shown.set("area.shadow", shadow);
    return shown.capture(Aov::Irradiance);
}

void expectSound(Shown& shown)
{
    const shader::CounterBlock counters = shown.counters();
    EXPECT_EQ(counters.nanPixels + counters.infPixels + counters.negativePixels, 0u);
}

// A lamp, and blocks that hide it from some of the floor, all of it or none.
scene::SceneFile blocks(std::initializer_list<vec3> positions)
{
    scene::SceneFile scene = darkScene();
    scene.entities.push_back(lampAt({0, 1.5f, 0}));
    for (const vec3 position : positions)
        scene.entities.push_back(blocker(position, vec3(0.3f)));
    return scene;
}

class AreaShares : public BackendTest<Backend>
{
};

TEST_P(AreaShares, WhatNothingHidesIsLitExactly)
{
    Shown shown(device(), blocks({}));
    shown.set("occlusion.backend", backend().name);
    const scene::ImageF whole = irradianceBy(shown, "none");
    for (const char* shadow : kShares) {
        SCOPED_TRACE(shadow);
        EXPECT_EQ(irradianceBy(shown, shadow).values, whole.values);
        expectSound(shown);
    }
}

// The more rays, the nearer the closed form; what is left with many is the filter's.
TEST_P(AreaShares, RatioGoesToTheClosedForm)
{
    Shown shown(device(), blocks({{0, 0.5f, 0}}), {192, 108});
    shown.set("occlusion.backend", backend().name);
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    const scene::ImageF closed = irradianceBy(shown, "analytic");
    const double light = meanOf(closed, surface);
    const auto errorWith = [&](const char* rays) {
        shown.set("area.rays", rays);
        return rmse(irradianceBy(shown, "ratio"), closed, surface) / light;
    };
    const double few = errorWith("2"), some = errorWith("16"), many = errorWith("256");
    EXPECT_LT(some, 0.7 * few);
    EXPECT_LT(many, some);
    EXPECT_LT(many, 0.02);
    EXPECT_GT(many, 0) << "the closed form was compared with itself";
    expectSound(shown);
}

// methods/penumbra.md: softening both sides of the border is the better of the two, and even the article's is better than no shadow.
TEST_P(AreaShares, TwoSidedIsNearerTheTruthThanTheArticle)
{
    for (const char* name : {"gallery", "leak"}) {
        SCOPED_TRACE(name);
        Shown shown(device(), namedScene(name, {{"area.scale", "1"}}), {192, 108});
        shown.set("occlusion.backend", backend().name);
        const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
        const scene::ImageF closed = irradianceBy(shown, "analytic");
        const auto errorBy = [&](const char* shadow) { return rmse(irradianceBy(shown, shadow), closed, surface); };
        const double none = errorBy("none"), article = errorBy("article"), twoSided = errorBy("two-sided");
        EXPECT_LT(article, 0.8 * none);
        EXPECT_LT(twoSided, 0.5 * article);
        expectSound(shown);
    }
}

TEST_P(AreaShares, OutsideAClosedBoxThereIsNoLight)
{
    scene::SceneFile scene = darkScene();
    scene.entities.push_back(lampAt({0, 1, 0}));
    scene.entities.push_back(blocker({0, 1, 0}, vec3(0.8f)));
    Shown shown(device(), scene);
    shown.set("occlusion.backend", backend().name);
    const std::vector<size_t> surface = surfaceOf(shown.capture(Aov::Depth));
    for (const char* shadow : kShares) {
        SCOPED_TRACE(shadow);
        EXPECT_EQ(meanOf(irradianceBy(shown, shadow), surface), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Truth, AreaShares, testing::Values(kRayQuery, kComputeBvh), backendName);

class AreaSharesTest : public DeviceTest
{
};

TEST_F(AreaSharesTest, HaveTheirOwnPassesAndNoOthers)
{
    Shown shown(device(), blocks({{0, 0.5f, 0}}));
    const auto steps = [&](const char* shadow) {
        shown.set("area.shadow", shadow);
        shown.draw();
        return stepsOf(shown);
    };
    EXPECT_THAT(steps("ratio"), IsSupersetOf({"area ratio trace", "area ratio denoise", "area ratio"}));
    EXPECT_THAT(steps("ratio"), Not(Contains("area penumbra")));
    EXPECT_THAT(steps("two-sided"), IsSupersetOf({"area shadow rays", "area penumbra", "area two-sided"}));
    EXPECT_THAT(steps("two-sided"), Not(Contains("area ratio trace")));
    EXPECT_THAT(steps("article"), Not(Contains("area tiles")));
    for (const char* pass : {"area ratio trace", "area ratio denoise", "area shadow rays", "area penumbra", "scene build"})
        EXPECT_THAT(steps("analytic"), Not(Contains(pass)));
}

TEST_F(AreaSharesTest, LightsThatAreShadowedDifferentlyAddUp)
{
    using enum scene::LightShadow;
    scene::SceneFile scene = darkScene();
    scene.entities.push_back(blocker({0, 0.4f, 0}, vec3(0.3f)));
    const auto litBy = [&](std::initializer_list<std::pair<float, scene::LightShadow>> lamps, Aov aov) {
        scene::SceneFile with = scene;
        for (const auto& [x, shadow] : lamps) {
            with.entities.push_back(lampAt({x, 1.2f, 0}));
            with.entities.back().areaLight->shadow = shadow;
        }
        Shown shown(device(), with);
        return shown.capture(aov);
    };
    const std::vector<size_t> surface = surfaceOf(litBy({{-0.8f, None}}, Aov::Depth));
    scene::ImageF sum = litBy({{-0.8f, Analytic}}, Aov::Irradiance);
    for (const auto& lamp : {std::pair(0.0f, Article), std::pair(0.8f, TwoSided)}) {
        const scene::ImageF one = litBy({lamp}, Aov::Irradiance);
        for (size_t i = 0; i < sum.values.size(); ++i)
            sum.values[i] += one.values[i];
    }
    const scene::ImageF all = litBy({{0.8f, TwoSided}, {-0.8f, Analytic}, {0.0f, Article}}, Aov::Irradiance);
    EXPECT_LT(rmse(all, sum, surface), 2e-3 * meanOf(sum, surface));
}

TEST_F(AreaSharesTest, AMovingLightTakesNoMemory)
{
    Shown shown(device(), namedScene("stage"));
    shown.set("area.scale", "1/4");
    for (const char* shadow : kShares) {
        SCOPED_TRACE(shadow);
        shown.set("area.shadow", shadow);
        const auto move = [&] {
            for (render::AreaLightDraw& light : shown.view().areaLights)
                light.world[3].y += 0.01f;
            shown.draw();
        };
        for (int i = 0; i < 6; ++i)
            move();
        const uint64_t before = shown.renderer().memory().allocationsEver;
        for (int i = 0; i < 10; ++i)
            move();
        EXPECT_EQ(shown.renderer().memory().allocationsEver, before);
        expectSound(shown);
    }
}

} // namespace
} // namespace antumbra::truth
