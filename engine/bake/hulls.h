// Convex hulls as blockers of area lights: of points, and one a bone of a model. Decomposes nothing that is not convex.
#pragma once

#include "scene/convex_body.h"
#include "scene/model.h"

namespace antumbra::bake {

/// The convex hull, coplanar facets merged within 1e-6 of the extent; a planar body (of no particular sense) where the points are
/// flat within 4e-6 of it, nothing where they are collinear within that or less than 1e-30 m apart.
/// A hull of more vertices than `greatestVertices` (4 at least) is simplified to at most that many (simplified_hull.h).
/// Throws Error for coordinates that are not finite or beyond 1e30 m.
std::optional<scene::ConvexBody> convexHull(std::span<const vec3> points, uint32_t greatestVertices);

/// In bind space: joint `joint` moves it.
struct Hull
{
    scene::ConvexBody body;
    uint32_t joint = 0;             // into Model::joints
    std::vector<uint32_t> vertices; // of the model's mesh, that it is the hull of
};

enum class HullsBy { Joint, Piece };

/// One for each joint that triangles belong to (scene/triangle_joints.h), or for each piece of these that hangs together
/// (scene/mesh_pieces.h), in the order of the joints, unless they have no area. Morph targets are not looked at. Errors as above, named
/// after the model.
std::vector<Hull> hullsOfModel(const scene::Model& model, uint32_t greatestVertices, HullsBy by = HullsBy::Joint);

} // namespace antumbra::bake
