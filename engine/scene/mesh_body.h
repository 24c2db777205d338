// Convex bodies out of triangles: the whole mesh where it is closed and convex, else one a triangle. Decomposes nothing.
#pragma once

#include "scene/convex_body.h"

namespace antumbra::scene {

/// The body that a closed convex mesh bounds, in bind space. Vertices that differ by rounding alone (seams) count as one, coplanar
/// triangles become one face. Nothing where the mesh is not closed or not convex. Positions must be finite.
std::optional<ConvexBody> meshBody(const Mesh& mesh);

/// One planar body a triangle, seen from its front. Left out where the height over the longest edge is under 1e-6 of that edge.
std::vector<ConvexBody> triangleBodies(const Mesh& mesh);

} // namespace antumbra::scene
