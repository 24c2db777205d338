// A convex body out of a closed polyhedron whose faces may be split and whose corners may be rounded. Closes no holes.
#pragma once

#include "scene/convex_body.h"

namespace antumbra::scene {

/// Exact: no vertex lies in front of a face, as in a hull. Rounded: they would not, had they not been computed and stored in float.
enum class Corners { Exact, Rounded };

/// In metres, what counts as no distance between these points: 1e-6 of their extent, more where they lie far from the origin.
double roundingOf(std::span<const vec3> points);

/// Faces of one plane become one, and vertices on no true edge are left out: neither moves the surface by more than eight times
/// roundingOf(). Where it would, faces stay as they are. Vertices that no loop uses are left out.
/// Nothing where the loops, counter-clockwise seen from outside, do not close, or where a vertex lies in front of a face by more
/// than that (Rounded: or more than rounding may have turned the face).
std::optional<ConvexBody> mergedBody(std::span<const vec3> vertices, std::span<const Loop> loops, Corners corners);

} // namespace antumbra::scene
