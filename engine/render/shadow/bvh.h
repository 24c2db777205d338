// Bounding volume hierarchies for devices without ray queries, as shaders/lib/bvh.glsl walks them. Searches for no splits: the loader's
// order of triangles is the tree (scene::orderTriangles), halved again and again as other builders do.
#pragma once

#include "render/shader_structs.h"

#include <span>
#include <vector>

namespace antumbra::render {

/// Leaves of the tree over that many triangles, a power of two: the fewest that hold no more than kBvhLeafTriangles each. So the tree is
/// never deeper than log2 of the triangles.
uint32_t bvhLeafCount(uint32_t triangleCount);

/// The tree over a mesh: 2 * bvhLeafCount nodes, numbered as in shaders/shared/bvh.h. The box of an empty mesh is empty.
std::vector<shader::BvhNode> bvhOf(std::span<const vec3> positions, std::span<const uint32_t> indices);

} // namespace antumbra::render
