// Baked light at a place, on the CPU.
#include "bake/look_up.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace antumbra::bake {
namespace {

constexpr uint16_t kHalfOne = 0x3c00;

/// Cells of two metres whose light is the environment's, multiplied by one in row and column 0 and by nothing elsewhere.
Bake bakeOfOneBand()
{
    Bake bake{.settings = {.bands = 2}};
    bake.volume.grid = {.origin = {0, 0, 0}, .spacing = {2, 2, 2}, .count = {3, 2, 4}};
    const size_t cells = bake.volume.grid.cellCount();
    bake.volume.isOpen.assign(cells, 1);
    bake.volume.planes.assign(size_t{kLocalCoefficients} * 4 * 3 * cells, 0);
    std::fill_n(bake.volume.planes.begin(), 3 * cells, kHalfOne);
    return bake;
}

ShFunction someLight()
{
    ShFunction light{.bands = 2, .coefficients = {}};
    for (uint32_t i = 0; i < 4; ++i)
        light.coefficients[i] = glm::dvec3(1 + i, 2 + i, 3 + i);
    return light;
}

TEST(LocalRadiance, InsideIsThatOfTheCells)
{
    const ShFunction light = someLight(), local = localRadiance(bakeOfOneBand(), light, {1.3f, 0.9f, 3.3f});
    EXPECT_EQ(local.bands, kLocalBands);
    EXPECT_LT(glm::length(local.coefficients[0] - light.coefficients[0]), 1e-6);
    EXPECT_EQ(local.coefficients[1], glm::dvec3(0));
}

TEST(LocalRadiance, ACellBeyondTheGridIsTheEnvironments)
{
    const ShFunction light = someLight();
    for (const vec3 position : {vec3(-3, 1, 1), vec3(7, 1, 1), vec3(1, 5, 1), vec3(1, 1, -1e6f)}) {
        const ShFunction local = localRadiance(bakeOfOneBand(), light, position);
        for (uint32_t i = 0; i < 4; ++i)
            EXPECT_LT(glm::length(local.coefficients[i] - light.coefficients[i]), 1e-6) << position.x << " " << i;
    }
}

TEST(LocalRadiance, BetweenItGoesOverWithoutAStep)
{
    const ShFunction light = someLight();
    const Bake bake = bakeOfOneBand();
    double before = 0;
    for (int i = 400; i <= 800; ++i) {
        const double value = localRadiance(bake, light, {static_cast<float>(i) / 100, 1, 1}).coefficients[1].x;
        EXPECT_GE(value, before - 1e-9);
        EXPECT_LE(value - before, 0.02 * light.coefficients[1].x);
        before = value;
    }
    EXPECT_NEAR(before, light.coefficients[1].x, 1e-6);
}

TEST(LocalRadiance, WithinWallsIsDark)
{
    Bake bake = bakeOfOneBand();
    std::ranges::fill(bake.volume.isOpen, uint8_t{0});
    EXPECT_EQ(localRadiance(bake, someLight(), {1, 1, 1}).coefficients[0], glm::dvec3(0));
}

} // namespace
} // namespace antumbra::bake
