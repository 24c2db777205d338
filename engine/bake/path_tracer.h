// The truth that bakes are held against: irradiance by path tracing of the very surfaces, without texels, cells or bands of transfer.
#pragma once

#include "bake/ray_scene.h"
#include "bake/sh.h"

#include <functional>

namespace antumbra::bake {

/// Of the environment towards a unit vector, W/(m^2 sr); an ShFunction is one.
using Radiance = std::function<glm::dvec3(const glm::dvec3& direction)>;

/// Irradiance, W/m^2, at a point with a normal (unit), of an environment given by `radiance` and `bounces` diffuse interreflections, by
/// `paths` paths. Noise falls with the root of their number at least; estimates of different seeds are independent of each other.
glm::dvec3 tracedIrradiance(const RayScene& rays, const Radiance& radiance, uint32_t bounces, vec3 position, vec3 normal, uint32_t paths,
                            uint64_t seed);

/// The same at a point of a triangle, by its shading normal; what lies behind the triangle's plane does not shine on it.
glm::dvec3 tracedIrradiance(const RayScene& rays, const Radiance& radiance, uint32_t bounces, const SurfacePoint& point, uint32_t paths,
                            uint64_t seed);

} // namespace antumbra::bake
