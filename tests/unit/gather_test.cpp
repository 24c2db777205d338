// Light transport of texels against closed forms, path tracing, and itself in another order.
#include "bake/path_tracer.h"
#include "gather_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace antumbra::bake {
namespace {

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

} // namespace
} // namespace antumbra::bake
