// Seams: edges over which the surface goes on smoothly while its charts lie apart on the page. Finds them, and makes what is looked up on
// their two sides agree.
#pragma once

#include "bake/gather.h"

#include <array>

namespace antumbra::bake {

/// A place on an edge as its two sides have it on the page.
using SeamPoint = std::array<vec2, 2>; // bakeUvs

/// Along every seam, two a texel at least.
std::vector<SeamPoint> seamPoints(const StaticScene& scene);

/// Transfers at some places of the page, in place of their sources'.
struct Stitched
{
    std::vector<uint32_t> places; // y * extent.x + x
    std::vector<float> values;    // one transfer a place, [coefficient * 3 + channel]
};

/// The transfers that bilinear look-ups at `points` read, moved so that both sides agree as nearly as they can without moving far: least
/// squares over all seams at once (Iwanicki, Lighting Technology of The Last of Us, 2013). Places beyond their chart, of which only seams
/// see much, move most. `sources`: the texel that every place of the page takes its value from, as dilated() tells.
Stitched stitched(std::span<const SeamPoint> points, const TexelMap& map, std::span<const uint32_t> sources, const Transfers& transfers);

} // namespace antumbra::bake
