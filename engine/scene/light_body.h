// The shape of an AreaLight as a convex body, curved shapes with flat faces. Knows no radiance and no place in the world.
#pragma once

#include "scene/mesh_body.h"
#include "scene/shadow_components.h"

namespace antumbra::scene {

/// In the light's own space (shadow_components.h), metres. Flat shapes are planar bodies that face +Y. `segments` (3..4096) are
/// - Disk: the corners of a polygon of the disk's (ellipse's) area.
/// - Sphere: about as many vertices, of 12, 32, 42, 92, 122, 162, 272, ...; the surface is the sphere's, and so is the mean area seen.
/// - Cylinder: the sides of a prism as long as the cylinder whose whole surface, caps and sides, is the cylinder's: it radiates
///   the same power. With 8 sides and length = diameter each cap has 2.7 % less area than the circle, the sides have 1.3 % more.
/// - Polygon: ignored; either sense of rotation, repeated and collinear corners do no harm.
/// - Mesh: ignored; `ownMesh` is the light's, and null for no other shape is asked for.
/// Nothing for a polygon without area, and for a mesh that is not closed and convex (triangleBodies() is there for it).
/// Sizes must be positive and finite.
std::optional<ConvexBody> lightBody(const AreaLight& light, const Mesh* ownMesh, uint32_t segments);

} // namespace antumbra::scene
