// Baked light at a place, on the CPU and in double: the twin of what the device looks up. For tests, and for measuring errors.
#pragma once

#include "bake/bake.h"
#include "bake/sh.h"

namespace antumbra::bake {

/// W/m^2, bilinear between the page's texels; `radiance` has the bake's bands.
glm::dvec3 atlasIrradiance(const Bake& bake, const ShFunction& radiance, vec2 bakeUv);

/// The radiance that comes in at a point, of kLocalBands: trilinear between the open cells. Zero where all cells about it are closed; the
/// environment's own from a cell beyond the grid on.
ShFunction localRadiance(const Bake& bake, const ShFunction& radiance, vec3 position);

/// The irradiance there of a surface that faces `normal`, W/m^2: of three bands by colour, and of the fifth, which is small, in the colour
/// of the first.
glm::dvec3 localIrradiance(const Bake& bake, const ShFunction& radiance, vec3 position, vec3 normal);

} // namespace antumbra::bake
