// The directions that the occlusion pass looks along.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <vector>

namespace antumbra::render {

/// The cosine-weighted Hammersley points about +Z of shaders/lib/hemisphere.glsl, ordered so that neighbours in the list are neighbours on
/// the hemisphere: rays that are traced together then stay together.
std::vector<vec3> hemisphereSamples(uint32_t count);

} // namespace antumbra::render
