// The samples of the occlusion pass and, for every cone there can be, which of them may lie in it (methods/conical-culling.md).
#pragma once

#include "base/math.h"

#include <cstdint>
#include <vector>

namespace antumbra::render {

/// The cosine-weighted Hammersley points about +Z of shaders/lib/hemisphere.glsl, ordered so that neighbours in the list are neighbours on
/// the hemisphere: rays that are traced together then stay together.
std::vector<vec3> hemisphereSamples(uint32_t count);

/// Bit s of word [cell][s / 32] is set unless sample s lies outside every cone of the cell; cells as in shaders/lib/mask_table.glsl,
/// a word for every 32 samples begun. 256 KiB for 128 samples.
std::vector<uint32_t> maskTable(const std::vector<vec3>& samples);

} // namespace antumbra::render
