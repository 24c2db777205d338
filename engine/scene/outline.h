// The convex outline of points in a plane. Knows nothing of the space the plane lies in.
#pragma once

#include "scene/convex_body.h"

namespace antumbra::scene {

/// The corners of the points' convex hull, counter-clockwise (x to y). Repeated points and corners nearer than 1e-6 of the extent
/// to the line through their neighbours are left out; less than three corners are left where all points are collinear within that.
Loop outlineOf(std::span<const glm::dvec2> points);

} // namespace antumbra::scene
