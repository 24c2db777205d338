// Path tracing against closed forms.
#include "bake/path_tracer.h"
#include "quad_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antumbra::bake {
namespace {

using glm::dvec3;

constexpr double kPiExact = std::numbers::pi;

ShFunction lightOf(uint32_t bands)
{
    ShFunction light{.bands = bands, .coefficients = {}};
    for (uint32_t i = 0; i < light.coefficientCount(); ++i)
        light.coefficients[i] = dvec3(std::sin(1.0 + i), std::cos(2.0 * i), 0.5);
    return light;
}

ShFunction constantLight(double radiance)
{
    ShFunction light{.bands = 3, .coefficients = {}};
    light.coefficients[0] = dvec3{radiance * std::sqrt(4 * kPiExact)};
    return light;
}

StaticScene floorOf(float metres)
{
    QuadScene scene(4, 0.6f);
    scene.addQuad({-0.5f * metres, 0, -0.5f * metres}, {0, 0, metres}, {metres, 0, 0});
    return scene.finished();
}

TEST(PathTracer, ConstantLightOnAnOpenPlaneIsPiTimesRadiance)
{
    const StaticScene scene = floorOf(10);
    const dvec3 irradiance = tracedIrradiance(RayScene(scene), constantLight(2), 3, {1, 0, 2}, {0, 1, 0}, 64, 1);
    EXPECT_NEAR(irradiance.x, 2 * kPiExact, 1.0e-6);
}

TEST(PathTracer, LightOfManyBandsIsConvolvedWithTheCosine)
{
    const StaticScene scene = floorOf(10);
    const ShFunction light = lightOf(5);
    const dvec3 normal = glm::normalize(dvec3(0.1, 1, -0.1));
    const dvec3 irradiance = tracedIrradiance(RayScene(scene), light, 0, {0, 10, 0}, vec3(normal), 4096, 1);
    const dvec3 expected = irradianceOf(light)(normal);
    EXPECT_LE(glm::length(irradiance - expected), 0.01 * glm::length(expected)) << "negative radiance counts too";
}

TEST(PathTracer, NoLightComesIntoAClosedRoom)
{
    QuadScene room(4);
    room.addBox({-1, 0, -1}, {1, 2, 1}, true);
    const StaticScene scene = room.finished();
    EXPECT_EQ(tracedIrradiance(RayScene(scene), constantLight(1), 4, {0, 0, 0}, {0, 1, 0}, 256, 1), dvec3{0});
}

// A point that looks down at an endless floor of albedo a sees radiance a E / pi everywhere, and E = pi L there.
TEST(PathTracer, AFloorSendsBackItsAlbedo)
{
    const StaticScene scene = floorOf(20000);
    const RayScene rays(scene);
    const auto irradianceBelow = [&](uint32_t bounces) {
        return tracedIrradiance(rays, constantLight(1), bounces, {0, 1, 0}, {0, -1, 0}, 256, 1).x;
    };
    EXPECT_EQ(irradianceBelow(0), 0);
    EXPECT_NEAR(irradianceBelow(1), 0.6 * kPiExact, 0.001 * kPiExact);
    EXPECT_NEAR(irradianceBelow(2), irradianceBelow(1), 1.0e-6);
}

TEST(PathTracer, SurfacesAreBlackFromBehind)
{
    const StaticScene scene = floorOf(20000);
    EXPECT_NEAR(tracedIrradiance(RayScene(scene), constantLight(1), 2, {0, -1, 0}, {0, 1, 0}, 256, 1).x, 0, 0.001);
}

TEST(PathTracer, WhatLiesBehindATriangleDoesNotShineOnIt)
{
    StaticScene scene = floorOf(10);
    for (vec3& normal : scene.normals)
        normal = glm::normalize(vec3(1, 0.5f, 0));
    const SurfacePoint point{0, {0.3f, 0.3f}};
    const dvec3 irradiance = tracedIrradiance(RayScene(scene), constantLight(1), 2, point, 4096, 1);
    // Of the lobe about a normal at an angle a to that of the plane, (1 + cos a) / 2 lies above it.
    EXPECT_NEAR(irradiance.x, kPiExact * (1 + 0.5 / std::hypot(1, 0.5)) / 2, 0.01 * kPiExact);
}

TEST(PathTracer, SeedsGiveIndependentEstimates)
{
    QuadScene room(4, 0.7f);
    room.addBox({-1, 0, -1}, {1, 2, 1}, true, true);
    const StaticScene scene = room.finished();
    const RayScene rays(scene);
    const auto estimate = [&](uint32_t paths, uint64_t seed) {
        return tracedIrradiance(rays, constantLight(1), 0, {0.3f, 0, 0.1f}, {0, 1, 0}, paths, seed).x;
    };
    EXPECT_EQ(estimate(16, 5), estimate(16, 5));
    const double truth = estimate(1u << 16, 0);
    constexpr int kEstimates = 200;
    double products = 0, squares = 0;
    for (int i = 0; i < kEstimates; ++i) {
        const auto seed = static_cast<uint64_t>(2 * i);
        const double a = estimate(16, seed + 1) - truth, b = estimate(16, seed + 2) - truth;
        products += a * b / kEstimates;
        squares += (a * a + b * b) / (2 * kEstimates);
    }
    EXPECT_GT(squares, 0);
    EXPECT_LE(std::abs(products), 4 * squares / std::sqrt(kEstimates));
}

} // namespace
} // namespace antumbra::bake
