// A convex body out of a closed polyhedron whose faces may be split and whose corners may be rounded. Closes no holes.
#pragma once

#include "scene/convex_body.h"

namespace antumbra::scene {

/// How far, in metres, places of these points may be off by having been computed and stored in float: 1e-6 of the greatest extent,
/// more where they lie far from the origin.
double roundingOf(std::span<const vec3> points);

/// Faces of one plane become one, and vertices on no true edge are left out. Nothing where the loops, counter-clockwise seen from
/// outside, do not close, or where a vertex lies in front of a face by more than `rounding` (more for small faces, whose planes are
/// less certain: as much as turning them by rounding / width moves the plane at that vertex).
std::optional<ConvexBody> mergedBody(std::span<const vec3> vertices, std::span<const Loop> loops, double rounding);

} // namespace antumbra::scene
