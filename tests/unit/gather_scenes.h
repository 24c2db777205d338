// What tests of gathering share: small scenes ready for it, light, and transfers as numbers.
#pragma once

#include "bake/gather.h"
#include "bake/sh.h"
#include "quad_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antumbra::bake {

using glm::dvec3;

inline constexpr double kPiExact = std::numbers::pi;
inline constexpr uint32_t kPoints = 4; // a texel

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

inline ShFunction constantLight(double radiance, uint32_t bands = 3)
{
    ShFunction light{.bands = bands, .coefficients = {}};
    light.coefficients[0] = dvec3{radiance * std::sqrt(4 * kPiExact)};
    return light;
}

/// From all sides, more from some; another in every channel.
inline ShFunction anyLight(uint32_t bands)
{
    ShFunction light = constantLight(1, bands);
    for (uint32_t i = 1; i < light.coefficientCount(); ++i)
        light.coefficients[i] = 0.3 * dvec3(std::sin(1.0 + i), std::cos(2.0 * i), std::sin(3.0 * i));
    return light;
}

inline dvec3 irradiance(const Transfers& transfers, uint32_t texel, const ShFunction& light)
{
    dvec3 sum{0};
    for (uint32_t i = 0; i < transfers.coefficientCount; ++i)
        sum += dvec3(transfers.values[size_t{texel} * transfers.coefficientCount + i]) * light.coefficients[i];
    return sum;
}

inline void add(Transfers& sum, const Transfers& more)
{
    for (size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] += more.values[i];
}

/// Every texel valid, and lit by a constant environment as `irradiance` says.
inline Transfers evenly(const Lit& lit, const BakeSettings& settings, float irradianceEverywhere)
{
    Transfers result = noTransfers(lit.map, settings);
    std::ranges::fill(result.isValid, uint8_t{1});
    for (uint32_t texel = 0; texel < lit.map.texelCount(); ++texel)
        result.values[size_t{texel} * result.coefficientCount] = vec3{irradianceEverywhere};
    return result;
}

inline StaticScene openPlane()
{
    QuadScene scene(4);
    scene.addQuad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0});
    return scene.finished();
}

/// A square metre of floor, a wall on its side of -X, all turned about +Y.
inline StaticScene floorAtWall(float radians)
{
    const mat3 turn(glm::rotate(mat4(1), radians, vec3(0, 1, 0)));
    QuadScene scene(4);
    scene.addQuad(turn * vec3(0, 0, -0.5f), turn * vec3(0, 0, 1), turn * vec3(1, 0, 0));
    scene.addQuad(turn * vec3(0, 0, -400), turn * vec3(0, 1, 0), turn * vec3(0, 0, 800));
    return scene.finished();
}

inline StaticScene roomWithoutCeiling()
{
    QuadScene scene(6, 0.7f);
    scene.addBox({-2, 0, -1.5f}, {2, 2.5f, 1.5f}, true, true);
    return scene.finished();
}

inline StaticScene cubeOnFloor()
{
    QuadScene scene(16);
    scene.addQuad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    scene.addBox({-1, 0, -1}, {1, 2, 1}, false);
    return scene.finished();
}

/// A floor of one square metre under a roof of a hundred, both of one material but for what `roof` says.
inline StaticScene roofed(const scene::Material& roof, bool hasBothSides = false)
{
    QuadScene scene(4);
    const uint32_t material = scene.addMaterial(roof);
    scene.addQuad({-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0});
    scene.addQuad({-50, 1, -50}, {100, 0, 0}, {0, 0, 100}, material);
    if (hasBothSides)
        scene.addQuad({-50, 1, -50}, {0, 0, 100}, {100, 0, 0}, material);
    return scene.finished();
}

} // namespace antumbra::bake
