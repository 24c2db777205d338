// Baked light at a place, on the CPU and in double: the twin of what the device looks up. For tests, and for measuring errors.
#pragma once

#include "bake/bake.h"
#include "bake/sh.h"

namespace antumbra::bake {

/// W/m^2, bilinear between the page's texels; `radiance` has the bake's bands.
glm::dvec3 atlasIrradiance(const Bake& bake, const ShFunction& radiance, vec2 bakeUv);

/// The radiance that comes in at a point, of three bands: trilinear between the open cells, looked up `normal` times 0.3 cells off the
/// surface (a unit vector, or zero). Zero where all cells about it are closed.
ShFunction localRadiance(const Bake& bake, const ShFunction& radiance, vec3 position, vec3 normal);

} // namespace antumbra::bake
