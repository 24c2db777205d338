#include "bake/texels.h"

#include <gtest/gtest.h>

#include <numeric>

namespace antumbra::bake {
namespace {

/// Triangles in the plane z = 0 whose place on the page is their place in the world.
StaticScene sceneOnPage(uvec2 extent, const std::vector<vec2>& corners)
{
    StaticScene scene;
    scene.atlasExtent = extent;
    for (const vec2 corner : corners) {
        scene.indices.push_back(static_cast<uint32_t>(scene.positions.size()));
        scene.positions.emplace_back(corner, 0.0f);
        scene.normals.emplace_back(0, 0, 1);
        scene.uvs.emplace_back(0);
        scene.bakeUvs.push_back(corner);
    }
    scene.triangleMaterials.assign(corners.size() / 3, 0);
    scene.materials.resize(1);
    return scene;
}

std::vector<vec2> quad(vec2 lowest, vec2 highest)
{
    return {lowest, {highest.x, lowest.y}, highest, lowest, highest, {lowest.x, highest.y}};
}

std::vector<uint8_t> allValid(const TexelMap& map) { return std::vector<uint8_t>(map.texelCount(), 1); }

TEST(Texels, EveryPointLiesInItsTexelAndOnTheSurface)
{
    const StaticScene scene = sceneOnPage({16, 8}, {{0.1f, 0.2f}, {0.83f, 0.31f}, {0.4f, 0.97f}});
    const TexelMap map = mapTexels(scene, 4);
    ASSERT_GT(map.texelCount(), 20u);
    for (uint32_t texel = 0; texel < map.texelCount(); ++texel) {
        ASSERT_FALSE(map.pointsOf(texel).empty());
        for (const SurfacePoint& point : map.pointsOf(texel)) {
            const vec2 onPage = bakeUvAt(scene, point) * vec2(map.extent);
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(onPage, vec2(map.places[texel]) - 1.0e-4f)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(onPage, vec2(map.places[texel]) + 1.0f + 1.0e-4f)));
        }
    }
}

TEST(Texels, WhatIsFullyCoveredHasAllPoints)
{
    const TexelMap map = mapTexels(sceneOnPage({4, 4}, quad({0.25f, 0.25f}, {0.75f, 0.75f})), 4);
    EXPECT_EQ(map.texelCount(), 4u);
    EXPECT_EQ(map.points.size(), 16u);
}

TEST(Texels, ASliverBetweenThePatternsPointsIsFound)
{
    const TexelMap map = mapTexels(sceneOnPage({8, 8}, {{0.01f, 0.001f}, {0.99f, 0.001f}, {0.99f, 0.0012f}}), 1);
    EXPECT_EQ(map.texelCount(), 8u);
    EXPECT_EQ(map.points.size(), 8u);
}

TEST(Texels, TheOrderOfTrianglesDoesNotMatter)
{
    std::vector<vec2> corners = quad({0.1f, 0.1f}, {0.9f, 0.63f});
    const StaticScene one = sceneOnPage({16, 16}, corners);
    std::rotate(corners.begin(), corners.begin() + 3, corners.end());
    const StaticScene other = sceneOnPage({16, 16}, corners);
    const TexelMap a = mapTexels(one, 4), b = mapTexels(other, 4);
    ASSERT_EQ(a.places, b.places);
    ASSERT_EQ(a.firstPoints, b.firstPoints);
    for (size_t i = 0; i < a.points.size(); ++i)
        EXPECT_LT(glm::distance(positionAt(one, a.points[i]), positionAt(other, b.points[i])), 1.0e-6f);
}

TEST(Texels, TrianglesWithoutAreaOnThePageAreNone)
{
    EXPECT_EQ(mapTexels(sceneOnPage({8, 8}, {{0.1f, 0.1f}, {0.5f, 0.5f}, {0.9f, 0.9f}}), 4).texelCount(), 0u);
}

TEST(Texels, AFootprintReproducesALinearFunction)
{
    const TexelMap map = mapTexels(sceneOnPage({8, 8}, quad(vec2(0), vec2(1))), 4);
    const vec2 uv{0.37f, 0.61f};
    const Footprint footprint = footprintAt(map, allValid(map), uv);
    ASSERT_EQ(footprint.count, 4u);
    vec2 sum{0};
    for (uint32_t k = 0; k < 4; ++k)
        sum += footprint.weights[k] * (vec2(map.places[footprint.texels[k]]) + 0.5f);
    EXPECT_LT(glm::distance(sum, uv * 8.0f), 1.0e-5f);
}

TEST(Texels, AFootprintLeavesOutWhatIsNotValid)
{
    const TexelMap map = mapTexels(sceneOnPage({8, 8}, quad(vec2(0), vec2(1))), 4);
    std::vector<uint8_t> isValid = allValid(map);
    isValid[map.texels[8 * 4 + 3]] = 0;
    const Footprint footprint = footprintAt(map, isValid, vec2(4.0f, 4.9f) / 8.0f);
    EXPECT_EQ(footprint.count, 3u);
    EXPECT_NEAR(std::accumulate(footprint.weights, footprint.weights + footprint.count, 0.0f), 1.0f, 1.0e-6f);
    std::ranges::fill(isValid, uint8_t{0});
    EXPECT_EQ(footprintAt(map, isValid, vec2(0.5f)).count, 0u);
}

TEST(Texels, DilationTakesTheNearestWithinReach)
{
    const TexelMap map = mapTexels(sceneOnPage({12, 3}, quad({0.0f, 0.0f}, {0.25f, 1.0f})), 1);
    const std::vector<uint32_t> sources = dilated(map, allValid(map), 2);
    const auto at = [&](uint32_t x, uint32_t y) { return sources[y * 12 + x]; };
    EXPECT_EQ(at(1, 1), map.texels[12 + 1]);
    EXPECT_EQ(at(3, 1), map.texels[12 + 2]);
    EXPECT_EQ(at(4, 2), map.texels[24 + 2]);
    EXPECT_EQ(at(5, 1), kNoTexel);
}

} // namespace
} // namespace antumbra::bake
