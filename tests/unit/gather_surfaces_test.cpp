// Surfaces that gathering must see as they are: holes, backs, solids, and what has no area or no number.
#include "gather_scenes.h"

#include <glm/gtc/packing.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace antumbra::bake {
namespace {

TEST(Gather, TexelsInsideSomethingSolidAreNotValid)
{
    const BakeSettings settings{.raysPerTexel = 256};
    const Lit lit(cubeOnFloor());
    const Transfers direct = lit.direct(settings), bounced = lit.bounce(settings, direct);
    uint32_t inside = 0, outside = 0;
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel) {
        uint32_t pointsInside = 0, floorPoints = 0;
        for (const SurfacePoint& point : lit.map.pointsOf(texel)) {
            const vec3 position = positionAt(lit.scene, point);
            floorPoints += point.triangle < 2;
            pointsInside += point.triangle < 2 && std::max(std::abs(position.x), std::abs(position.z)) < 1;
        }
        if (floorPoints == 0)
            continue;
        const bool isInside = pointsInside == floorPoints;
        (isInside ? inside : outside) += 1;
        EXPECT_EQ(direct.isValid[texel], isInside ? 0 : 1);
        EXPECT_EQ(bounced.isValid[texel], direct.isValid[texel]);
    }
    EXPECT_GT(inside, 8u);
    EXPECT_GT(outside, 100u);
}

TEST(Gather, WhatLiesInsideSomethingSolidDoesNotDarkenATexel)
{
    const BakeSettings settings{.raysPerTexel = 1024};
    const Lit lit(cubeOnFloor());
    const Transfers direct = lit.direct(settings);
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel)
        if (lit.map.pointsOf(texel).front().triangle < 2 && direct.isValid[texel]) {
            EXPECT_GE(irradiance(direct, texel, constantLight(1)).x, 0.45 * kPiExact) << "a wall takes half of the sky at most";
        }
}

TEST(Gather, CutOutSurfacesLetLightThroughTheirHoles)
{
    const BakeSettings settings{.raysPerTexel = 1024};
    const scene::Image8 holeTowardsMinusX{.width = 2, .height = 1, .rgba = {255, 255, 255, 0, 255, 255, 255, 255}};
    const auto irradianceUnder = [&](const scene::Material& roof) {
        StaticScene scene = roofed(roof);
        scene.images.push_back(&holeTowardsMinusX);
        const Lit lit(std::move(scene));
        return irradiance(lit.direct(settings), 0, constantLight(1)).x;
    };
    EXPECT_NEAR(irradianceUnder({.alpha = 0.2f, .alphaCutoff = 0.5f}), kPiExact, 0.005 * kPiExact);
    EXPECT_NEAR(irradianceUnder({.alpha = 0.9f, .alphaCutoff = 0.5f}), 0, 0.01 * kPiExact);
    // The texel is 0.375 m within the half that is open, a metre below its rim.
    const double expected = 0.5 + 0.5 * 0.375 / std::hypot(0.375, 1);
    EXPECT_NEAR(irradianceUnder({.alphaCutoff = 0.5f, .albedoImage = 0}), expected * kPiExact, 0.02 * kPiExact);
}

TEST(Gather, OfATwoSidedSurfaceRaysMeetTheSideThatFacesThem)
{
    const Lit lit(roofed({.albedo = vec3{0.5f}, .twoSided = true}, true));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-20, 20);
    for (int i = 0; i < 200; ++i) {
        const float from = i % 2 == 0 ? 0.5f : 1.5f;
        RayScene::Hit hit;
        ASSERT_TRUE(lit.rays.intersect({anywhere(random), from, anywhere(random)}, {0, i % 2 == 0 ? 1.0f : -1.0f, 0}, hit));
        EXPECT_FALSE(hit.isBack);
        EXPECT_NEAR(hit.distance, 0.5f, 1.0e-5f);
        EXPECT_EQ(hit.point.triangle / 2, i % 2 == 0 ? 1u : 2u);
    }
}

// Of the lobe about a normal at an angle a to that of the plane, (1 + cos a) / 2 lies above it.
TEST(Gather, WhatLiesBehindATriangleDoesNotShineOnIt)
{
    const BakeSettings settings;
    StaticScene scene = openPlane();
    std::ranges::fill(scene.normals, glm::normalize(vec3(1, 0.5f, 0)));
    const Lit lit(std::move(scene));
    EXPECT_NEAR(irradiance(lit.direct(settings), 0, constantLight(1)).x, kPiExact * (1 + 0.5 / std::hypot(1, 0.5)) / 2, 0.02 * kPiExact);
    EXPECT_THAT(lit.bounce(settings, evenly(lit, settings, 1)).values, testing::Each(vec3{0})) << "nor does the triangle itself";
}

TEST(Gather, SurfacesAreBlackFromBehind)
{
    const BakeSettings settings;
    QuadScene scene(4);
    scene.addQuad({-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0});
    scene.addQuad({-0.3f, 1, -0.3f}, {0, 0, 0.6f}, {0.6f, 0, 0});
    const Lit lit(scene.finished());
    EXPECT_THAT(lit.bounce(settings, evenly(lit, settings, 1)).values, testing::Each(vec3{0}));
    EXPECT_LT(irradiance(lit.direct(settings), 0, constantLight(1)).x, 0.98 * kPiExact) << "but they stop light";

    // The floor is one face of a cube about the cell: a sixth of what that sees.
    const Grid grid{.origin = {0, 0.5f, 0}, .spacing = vec3{1}, .count = uvec3{1}};
    const CellLight shining = lit.cells(settings, evenly(lit, settings, 1), grid),
                    dark = lit.cells(settings, evenly(lit, settings, 0), grid);
    EXPECT_NEAR(shining.values[0].x - dark.values[0].x, 0.5f / kPi * std::sqrt(4 * kPi) / 6, 0.005f);
}

TEST(Gather, TrianglesWithoutAreaDoNoHarm)
{
    const BakeSettings settings{.raysPerTexel = 64};
    QuadScene scene(4);
    scene.addQuad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    scene.addQuad({0, 1, 0}, {1, 0, 0}, {0, 0, 0});
    const Lit lit(scene.finished());
    const Transfers direct = lit.direct(settings), bounced = lit.bounce(settings, direct);
    EXPECT_NEAR(irradiance(direct, 0, constantLight(1)).x, kPiExact, 0.005 * kPiExact);
    for (size_t i = 0; i < direct.values.size(); ++i) {
        EXPECT_TRUE(std::isfinite(direct.values[i].x));
        EXPECT_TRUE(std::isfinite(bounced.values[i].x));
    }
}

TEST(Gather, AlbedoThatIsNotANumberIsBlack)
{
    const BakeSettings settings{.raysPerTexel = 64, .raysPerCell = 64};
    const Lit lit(roofed({.albedo = vec3{std::numeric_limits<float>::quiet_NaN()}}));
    const Transfers bounced = lit.bounce(settings, evenly(lit, settings, 1));
    EXPECT_EQ(bounced.values[0].x, 0.0f);
    const CellLight cells = lit.cells(settings, evenly(lit, settings, 1), {.origin = {0, 0.5f, 0}, .spacing = vec3{1}, .count = uvec3{1}});
    for (const vec3& value : cells.values)
        EXPECT_TRUE(std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z));
}

TEST(Gather, PackedTransfersSpreadBeyondTheirCharts)
{
    const BakeSettings settings{.bands = 2};
    const Lit lit(openPlane()); // texels 1..4 of a page of 6 x 6
    Transfers transfers = evenly(lit, settings, 2);
    transfers.values[3] = {1, 1.0e9f, -0.5f};
    const TransferAtlas atlas = packed(transfers, lit.map, lit.scene);
    ASSERT_EQ(atlas.extent, uvec2(6));
    ASSERT_EQ(atlas.planes.size(), 36u * 4 * 3);
    EXPECT_EQ(glm::unpackHalf1x16(atlas.planes[0]), 2.0f) << "the page's corner takes the chart's";
    EXPECT_EQ(glm::unpackHalf1x16(atlas.planes[(3 * 3 + 0) * 36]), 1.0f);
    EXPECT_EQ(glm::unpackHalf1x16(atlas.planes[(3 * 3 + 1) * 36]), 65280.0f) << "the largest half of eight significant bits";
    EXPECT_EQ(glm::unpackHalf1x16(atlas.planes[(3 * 3 + 2) * 36]), -0.5f);
    EXPECT_EQ(glm::unpackHalf1x16(atlas.planes[(3 * 3 + 2) * 36 + 35]), 0.0f) << "the other corner takes another texel's";
}

} // namespace
} // namespace antumbra::bake
