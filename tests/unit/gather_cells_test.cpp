// What light comes into the cells of a grid, and the grid itself.
#include "gather_scenes.h"

#include <glm/gtc/packing.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace antumbra::bake {
namespace {

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
