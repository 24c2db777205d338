// The truth that bakes are held against: irradiance by path tracing of the very surfaces, without texels, cells or bands of transfer.
#pragma once

#include "bake/gather.h"
#include "bake/sh.h"

namespace antumbra::bake {

/// Irradiance, W/m^2, at a point with a normal (unit), of an environment given by `radiance` and `bounces` diffuse interreflections, by
/// `paths` paths. Noise falls with the root of their number. `seed` tells points apart.
glm::dvec3 tracedIrradiance(const RayScene& rays, const ShFunction& radiance, uint32_t bounces, vec3 position, vec3 normal, uint32_t paths,
                            uint64_t seed);

} // namespace antumbra::bake
