// Charts: pieces of a surface laid flat on a plane, where nothing folds over and nothing overlaps. Knows neither texels nor pages.
#pragma once

#include "bake/regions.h"

#include <vector>

namespace antumbra::bake {

struct Chart
{
    std::vector<uint32_t> triangles; // of the surface
    std::vector<vec2> corners;       // three a triangle, metres from the lower left of its box
    vec2 extent{0};                  // of the box, metres; it lies on its longer side
};

/// Every triangle in one chart. A chart has the area of its surface, and each triangle on it its own within a factor of the cosine of
/// kRegionHalfAngle.
std::vector<Chart> chartsOf(const Surface& surface);

/// Scales the corners, so that the chart has the area of its triangles on the surface.
void scaleToSurface(Chart& chart, const Surface& surface);
/// Moves and turns the corners, so that they lie in the smallest box; sets the extent.
void layInBox(Chart& chart);

} // namespace antumbra::bake
