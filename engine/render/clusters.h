// A model's triangles cut for drawing: clusters of one material that lie close together, so that a view leaves out what it does
// not see and draws what is near first. Knows nothing of the device, and nothing of how a cluster is shaded.
#pragma once

#include "base/bounds.h"
#include "scene/model.h"

#include <optional>
#include <vector>

namespace antumbra::render {

struct Cluster
{
    Aabb box;              // of the model at rest
    uint32_t material = 0; // into scene::Model::materials
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;
};

/// Every triangle of the mesh once, with its corners in their order: `indices` as the clusters count them.
struct ClusteredTriangles
{
    std::vector<uint32_t> indices;
    std::vector<Cluster> clusters; // by material
};

/// Clusters of at most `mostTriangles`, 1 or more. `restPositions`: as scene::orderTriangles takes them.
ClusteredTriangles clustersOf(const scene::Mesh& mesh, std::span<const vec3> restPositions, uint32_t mostTriangles);

/// The view depth behind which nothing of the box lies, in metres; none where the box is outside the view for certain. The last row of
/// `clipFromLocal` gives the view depth, and depth is reversed without a far plane.
std::optional<float> farthestSeen(const Aabb& box, const mat4& clipFromLocal);

} // namespace antumbra::render
