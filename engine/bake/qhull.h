// The faces of a convex hull, by Qhull (Barber, Dobkin, Huhdanpaa 1996). The only file that sees Qhull; it prints nothing and never
// joggles.
#pragma once

#include "scene/convex_body.h"

namespace antumbra::bake {

/// Loops into `points`, counter-clockwise seen from outside; facets that Qhull finds coplanar within rounding in double are one. The
/// points must span space, at an extent of about one: handle flat sets before. Throws Error where Qhull finds no hull.
std::vector<scene::Loop> hullLoops(std::span<const glm::dvec3> points);

/// The same as a body of the points that are vertices, at any extent; facets coplanar within rounding in float are one too.
scene::ConvexBody solidHull(std::span<const vec3> points);

} // namespace antumbra::bake
