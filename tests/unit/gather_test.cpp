// Light transport of texels and cells against closed forms, path tracing, and itself in another order.
#include "bake/gather.h"
#include "bake/path_tracer.h"
#include "quad_scene.h"

#include <glm/gtc/packing.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace antumbra::bake {
namespace {

using glm::dvec3;

constexpr double kPiExact = std::numbers::pi;
constexpr uint32_t kPoints = 4; // a texel

/// A static scene ready for gathering.
struct Lit
{
    explicit Lit(StaticScene staticScene) : scene(std::move(staticScene)), map(mapTexels(scene, kPoints)), rays(scene) {}

    [[nodiscard]] Transfers direct(const BakeSettings& settings) const
    {
        Transfers result = noTransfers(map, settings);
        gatherDirect(rays, map, settings, {0, map.texelCount()}, result);
        return result;
    }
    [[nodiscard]] Transfers bounce(const BakeSettings& settings, const Transfers& before) const
    {
        Transfers result = noTransfers(map, settings);
        gatherBounce(rays, map, settings, before, {0, map.texelCount()}, result);
        return result;
    }
    [[nodiscard]] CellLight cells(const BakeSettings& settings, const Transfers& lit, const Grid& grid) const
    {
        CellLight result = noCellLight(grid, settings);
        gatherCells(rays, map, settings, lit, grid, {0, grid.cellCount()}, result);
        return result;
    }

    StaticScene scene;
    TexelMap map;
    RayScene rays;
};

ShFunction constantLight(double radiance, uint32_t bands = 3)
{
    ShFunction light{.bands = bands, .coefficients = {}};
    light.coefficients[0] = dvec3{radiance * std::sqrt(4 * kPiExact)};
    return light;
}

/// From all sides, more from some; another in every channel.
ShFunction anyLight(uint32_t bands)
{
    ShFunction light = constantLight(1, bands);
    for (uint32_t i = 1; i < light.coefficientCount(); ++i)
        light.coefficients[i] = 0.3 * dvec3(std::sin(1.0 + i), std::cos(2.0 * i), std::sin(3.0 * i));
    return light;
}

dvec3 irradiance(const Transfers& transfers, uint32_t texel, const ShFunction& light)
{
    dvec3 sum{0};
    for (uint32_t i = 0; i < transfers.coefficientCount; ++i)
        sum += dvec3(transfers.values[size_t{texel} * transfers.coefficientCount + i]) * light.coefficients[i];
    return sum;
}

void add(Transfers& sum, const Transfers& more)
{
    for (size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] += more.values[i];
}

/// Every texel valid, and lit by a constant environment as `irradiance` says.
Transfers evenly(const Lit& lit, const BakeSettings& settings, float irradianceEverywhere)
{
    Transfers result = noTransfers(lit.map, settings);
    std::ranges::fill(result.isValid, uint8_t{1});
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel)
        result.values[size_t{texel} * result.coefficientCount] = vec3{irradianceEverywhere};
    return result;
}

StaticScene openPlane()
{
    QuadScene scene(4);
    scene.addQuad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0});
    return scene.finished();
}

/// A square metre of floor, a wall on its side of -X, all turned about +Y.
StaticScene floorAtWall(float radians)
{
    const mat3 turn(glm::rotate(mat4(1), radians, vec3(0, 1, 0)));
    QuadScene scene(4);
    scene.addQuad(turn * vec3(0, 0, -0.5f), turn * vec3(0, 0, 1), turn * vec3(1, 0, 0));
    scene.addQuad(turn * vec3(0, 0, -400), turn * vec3(0, 1, 0), turn * vec3(0, 0, 800));
    return scene.finished();
}

StaticScene roomWithoutCeiling()
{
    QuadScene scene(6, 0.7f);
    scene.addBox({-2, 0, -1.5f}, {2, 2.5f, 1.5f}, true, true);
    return scene.finished();
}

StaticScene cubeOnFloor()
{
    QuadScene scene(16);
    scene.addQuad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    scene.addBox({-1, 0, -1}, {1, 2, 1}, false);
    return scene.finished();
}

/// A floor of one square metre under a roof of a hundred, both of one material but for what `roof` says.
StaticScene roofed(const scene::Material& roof, bool hasBothSides = false)
{
    QuadScene scene(4);
    const uint32_t material = scene.addMaterial(roof);
    scene.addQuad({-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0});
    scene.addQuad({-50, 1, -50}, {100, 0, 0}, {0, 0, 100}, material);
    if (hasBothSides)
        scene.addQuad({-50, 1, -50}, {0, 0, 100}, {100, 0, 0}, material);
    return scene.finished();
}

TEST(Gather, ConstantLightOnAnOpenPlaneIsPiTimesRadiance)
{
    const BakeSettings settings;
    const Lit lit(openPlane());
    const Transfers transfers = lit.direct(settings);
    ASSERT_EQ(lit.map.texelCount(), 16u);
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel) {
        EXPECT_EQ(transfers.isValid[texel], 1);
        EXPECT_NEAR(irradiance(transfers, texel, constantLight(2)).x, 2 * kPiExact, 0.005 * 2 * kPiExact);
    }
}

class GatherBands : public testing::TestWithParam<uint32_t>
{
};

TEST_P(GatherBands, LightOfEveryBandOnAnOpenPlaneIsItsCosineConvolution)
{
    const BakeSettings settings{.bands = GetParam()};
    const Lit lit(openPlane());
    const Transfers transfers = lit.direct(settings);
    const ShFunction light = anyLight(settings.bands);
    const dvec3 expected = irradianceOf(light)({0, 1, 0});
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel)
        EXPECT_LE(glm::length(irradiance(transfers, texel, light) - expected), 0.005 * glm::length(expected));
}

INSTANTIATE_TEST_SUITE_P(AllBands, GatherBands, testing::Values(2u, 3u, 4u, 5u));

// An endless wall of height h at a distance d of a level surface covers (1 - d / sqrt(d^2 + h^2)) / 2 of its cosine-weighted sky.
TEST(Gather, AWallTakesItsFormFactor)
{
    const BakeSettings settings{.raysPerTexel = 4096};
    const Lit lit(floorAtWall(0));
    const Transfers transfers = lit.direct(settings);
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel) {
        double expected = 0, floorPoints = 0;
        for (const SurfacePoint& point : lit.map.pointsOf(texel)) {
            const vec3 position = positionAt(lit.scene, point);
            if (geometricNormal(lit.scene, point.triangle).y > 0.5f) {
                expected += kPiExact * (0.5 + 0.5 * position.x / std::hypot(position.x, 1.0));
                ++floorPoints;
            }
        }
        if (floorPoints > 0) {
            EXPECT_NEAR(irradiance(transfers, texel, constantLight(1)).x, expected / floorPoints, 0.01 * kPiExact);
        }
    }
}

TEST(Gather, BouncesInAClosedRoomAreTheGeometricSeries)
{
    constexpr float kAlbedo = 0.8f;
    const BakeSettings settings{.raysPerTexel = 256};
    QuadScene box(4, kAlbedo);
    box.addBox({-1, 0, -2}, {3, 2.5f, 2}, true);
    const Lit lit(box.finished());
    Transfers now = evenly(lit, settings, 3);
    std::vector<double> sums(lit.map.texelCount());
    double series = 0;
    for (int bounce = 1; bounce <= 4; ++bounce) {
        now = lit.bounce(settings, now);
        series += 3 * std::pow(kAlbedo, bounce);
        for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel) {
            sums[texel] += now.values[size_t{texel} * now.coefficientCount].x;
            EXPECT_NEAR(sums[texel], series, 0.01 * series) << "bounce " << bounce << ", texel " << texel;
        }
    }
}

TEST(Gather, NoLightComesIntoAClosedRoom)
{
    const BakeSettings settings{.raysPerTexel = 64};
    QuadScene box(4);
    box.addBox({-1, 0, -2}, {3, 2.5f, 2}, true);
    const Transfers transfers = Lit(box.finished()).direct(settings);
    EXPECT_THAT(transfers.values, testing::Each(vec3{0}));
}

TEST(Gather, AgreesWithPathTracing)
{
    const BakeSettings settings;
    const Lit lit(roomWithoutCeiling());
    Transfers total = lit.direct(settings), now = total;
    for (uint32_t bounce = 0; bounce < settings.bounces; ++bounce)
        add(total, now = lit.bounce(settings, now));

    const ShFunction light = anyLight(settings.bands);
    double squares = 0, mean = 0;
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel) {
        const auto points = lit.map.pointsOf(texel);
        dvec3 truth{0};
        for (const SurfacePoint& point : points)
            truth += tracedIrradiance(lit.rays, light, settings.bounces, point, 512, texel) / static_cast<double>(points.size());
        const dvec3 difference = irradiance(total, texel, light) - truth;
        squares += glm::dot(difference, difference) / 3 / lit.map.texelCount();
        mean += (truth.x + truth.y + truth.z) / 3 / lit.map.texelCount();
    }
    EXPECT_LE(std::sqrt(squares) / mean, 0.02);
}

TEST(Gather, TurningSceneAndLightTogetherChangesNothing)
{
    const BakeSettings settings{.raysPerTexel = 4096};
    const Lit straight(floorAtWall(0)), turned(floorAtWall(1.1f));
    const Transfers a = straight.direct(settings), b = turned.direct(settings);
    const ShFunction light = anyLight(3), turnedLight = rotatedAboutY(light, static_cast<double>(1.1f));
    ASSERT_EQ(straight.map.texelCount(), turned.map.texelCount());
    for (uint32_t texel = 0; texel < straight.map.texelCount(); ++texel)
        EXPECT_LE(glm::length(irradiance(a, texel, light) - irradiance(b, texel, turnedLight)), 0.03);
}

TEST(Gather, TheOrderOfTrianglesChangesNothing)
{
    const BakeSettings settings{.raysPerTexel = 128};
    StaticScene scene = roomWithoutCeiling();
    const Lit ordered(scene);
    std::vector<std::array<uint32_t, 3>> triangles;
    for (size_t i = 0; i < scene.indices.size(); i += 3)
        triangles.push_back({scene.indices[i], scene.indices[i + 1], scene.indices[i + 2]});
    std::ranges::shuffle(triangles, std::mt19937(7));
    scene.indices.clear();
    for (const auto& triangle : triangles)
        scene.indices.insert(scene.indices.end(), triangle.begin(), triangle.end());
    const Lit shuffled(std::move(scene));

    const Transfers direct = ordered.direct(settings), directShuffled = shuffled.direct(settings);
    const Transfers bounced = ordered.bounce(settings, direct), bouncedShuffled = shuffled.bounce(settings, directShuffled);
    ASSERT_EQ(direct.values.size(), directShuffled.values.size());
    for (size_t i = 0; i < direct.values.size(); ++i) {
        EXPECT_LE(glm::length(direct.values[i] - directShuffled.values[i]), 1.0e-5f);
        EXPECT_LE(glm::length(bounced.values[i] - bouncedShuffled.values[i]), 1.0e-5f);
    }
}

TEST(Gather, RangesInAnyOrderGiveTheSameBytes)
{
    const BakeSettings settings{.raysPerTexel = 64, .raysPerCell = 64};
    const Lit lit(roomWithoutCeiling());
    const Grid grid = gridOver(lit.scene.bounds(), 1);
    const Transfers direct = lit.direct(settings), bounced = lit.bounce(settings, direct);
    const CellLight cells = lit.cells(settings, direct, grid);

    Transfers directInParts = noTransfers(lit.map, settings), bouncedInParts = directInParts;
    CellLight cellsInParts = noCellLight(grid, settings);
    for (uint32_t texel = lit.map.texelCount(); texel-- > 0;)
        gatherDirect(lit.rays, lit.map, settings, {texel, 1}, directInParts);
    for (uint32_t texel = lit.map.texelCount(); texel-- > 0;)
        gatherBounce(lit.rays, lit.map, settings, directInParts, {texel, 1}, bouncedInParts);
    for (uint32_t cell = grid.cellCount(); cell-- > 0;)
        gatherCells(lit.rays, lit.map, settings, directInParts, grid, {cell, 1}, cellsInParts);

    const auto areSame = [](const std::vector<vec3>& a, const std::vector<vec3>& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(vec3)) == 0;
    };
    EXPECT_TRUE(areSame(direct.values, directInParts.values));
    EXPECT_TRUE(areSame(bounced.values, bouncedInParts.values));
    EXPECT_TRUE(areSame(cells.values, cellsInParts.values));
    EXPECT_EQ(direct.isValid, directInParts.isValid);
    EXPECT_EQ(bounced.isValid, bouncedInParts.isValid);
    EXPECT_EQ(cells.isOpen, cellsInParts.isOpen);
}

TEST(Gather, RaysAreCounted)
{
    const BakeSettings settings{.raysPerTexel = 256, .raysPerCell = 100};
    const Lit lit(openPlane());
    Transfers transfers = noTransfers(lit.map, settings);
    EXPECT_EQ(gatherDirect(lit.rays, lit.map, settings, {2, 3}, transfers).rays, 3u * 256u);
    const Grid grid{.origin = {0, 1, 0}, .spacing = vec3{1}, .count = {2, 1, 1}};
    CellLight cells = noCellLight(grid, settings);
    EXPECT_EQ(gatherCells(lit.rays, lit.map, settings, transfers, grid, {0, 2}, cells).rays, 2u * 112u);
}

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

TEST(Gather, AnOpenCellSeesTheEnvironmentAsItIs)
{
    const BakeSettings settings{.bands = 5};
    QuadScene scene(4);
    scene.addQuad({0, -1000, 0}, {0, 0, 0.01f}, {0.01f, 0, 0});
    const Lit lit(scene.finished());
    const Grid grid{.origin = {-1, 0, 3}, .spacing = vec3{0.5f}, .count = {2, 2, 2}};
    const CellLight cells = lit.cells(settings, noTransfers(lit.map, settings), grid);
    for (uint32_t cell = 0; cell < grid.cellCount(); ++cell) {
        EXPECT_EQ(cells.isOpen[cell], 1);
        for (uint32_t j = 0; j < kLocalCoefficients; ++j)
            for (uint32_t i = 0; i < settings.coefficientCount(); ++i) {
                const vec3 entry = cells.values[(size_t{cell} * kLocalCoefficients + j) * settings.coefficientCount() + i];
                EXPECT_LE(glm::length(entry - vec3{i == j ? 1.0f : 0.0f}), 1.0e-3f) << j << ", " << i;
            }
    }
}

TEST(Gather, ACellSeesTheSurfacesShine)
{
    constexpr float kAlbedo = 0.6f;
    const BakeSettings settings;
    QuadScene box(4, kAlbedo);
    box.addBox({-1, 0, -2}, {3, 2.5f, 2}, true);
    const Lit lit(box.finished());
    const Grid grid{.origin = {0, 1, 0}, .spacing = vec3{1}, .count = {2, 1, 1}};
    const CellLight cells = lit.cells(settings, evenly(lit, settings, 3), grid);
    const float radianceEverywhere = 3 * kAlbedo / kPi;
    for (uint32_t cell = 0; cell < grid.cellCount(); ++cell)
        for (uint32_t j = 0; j < kLocalCoefficients; ++j) {
            const vec3 entry = cells.values[(size_t{cell} * kLocalCoefficients + j) * settings.coefficientCount()];
            EXPECT_NEAR(entry.x, j == 0 ? radianceEverywhere * std::sqrt(4 * kPi) : 0.0f, 2.0e-3f) << j;
        }
}

TEST(Gather, ACellInsideSomethingSolidIsClosed)
{
    const BakeSettings settings;
    const Lit lit(cubeOnFloor());
    const Grid grid{.origin = {0, 1, 0}, .spacing = vec3{2}, .count = {1, 2, 1}};
    const CellLight cells = lit.cells(settings, lit.direct(settings), grid);
    EXPECT_THAT(cells.isOpen, testing::ElementsAre(0, 1));
    EXPECT_EQ(cells.values[0], vec3{0});
    EXPECT_GT(cells.values[size_t{kLocalCoefficients} * settings.coefficientCount()].x, 0.4f);
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

TEST(Gather, RaysTurnFromTexelToTexel)
{
    const BakeSettings settings{.raysPerTexel = 64};
    const Lit lit(floorAtWall(0));
    const Transfers direct = lit.direct(settings);
    std::vector<double> alongTheWall; // where the truth is the same
    for (uint32_t x = 1; x <= 4; ++x)
        alongTheWall.push_back(irradiance(direct, lit.map.texels[lit.map.extent.x + x], constantLight(1)).x);
    EXPECT_GT(std::ranges::max(alongTheWall) - std::ranges::min(alongTheWall), 1.0e-4);
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

TEST(Gather, TheGridCoversTheSceneAndWhoStandsInIt)
{
    const Grid hall = gridOver({.lowest = {-4, 0, -8}, .highest = {16, 7.5f, 8}}, 0.8f);
    EXPECT_EQ(hall.count, uvec3(25, 10, 20));
    EXPECT_NEAR(glm::length(hall.origin - vec3(-3.6f, 0.375f, -7.6f)), 0, 1.0e-5);
    EXPECT_NEAR(glm::length(hall.position(hall.cellCount() - 1) - vec3(15.6f, 7.125f, 7.6f)), 0, 1.0e-4);

    const Grid plane = gridOver({.lowest = {-1, 0, 0}, .highest = {1, 0, 0}}, 1);
    EXPECT_EQ(plane.count, uvec3(2, 2, 1));
    EXPECT_GT(plane.origin.y, 0);
    EXPECT_GT(plane.spacing.z, 0);
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

TEST(Gather, PackedCellsAreZeroWhereTheyAreClosed)
{
    const BakeSettings settings{.bands = 2};
    const Grid grid{.origin = {}, .spacing = vec3{1}, .count = {2, 1, 1}};
    CellLight light = noCellLight(grid, settings);
    std::ranges::fill(light.values, vec3(1, 2, 3));
    light.isOpen = {0, 1};
    const IrradianceVolume volume = packed(light, grid);
    ASSERT_EQ(volume.planes.size(), size_t{2} * kLocalCoefficients * 4 * 3);
    EXPECT_EQ(volume.isOpen, light.isOpen);
    for (size_t plane = 0; plane < volume.planes.size() / 2; ++plane) {
        EXPECT_EQ(volume.planes[2 * plane], 0);
        EXPECT_EQ(glm::unpackHalf1x16(volume.planes[2 * plane + 1]), static_cast<float>(plane % 3 + 1));
    }
}

} // namespace
} // namespace antumbra::bake
