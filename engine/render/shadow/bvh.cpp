#include "render/shadow/bvh.h"

#include "base/bounds.h"
#include "base/check.h"

#include <algorithm>
#include <bit>

namespace antumbra::render {

namespace {

using shader::BvhNode;

/// The ranges of triangles of a node's halves, the larger one first, as the loader orders them.
void halve(std::vector<BvhNode>& nodes, uint32_t node)
{
    BvhNode& left = nodes[2 * size_t{node}];
    BvhNode& right = nodes[2 * size_t{node} + 1];
    left = right = nodes[node];
    left.triangleCount = (left.triangleCount + 1) / 2;
    right.triangleCount -= left.triangleCount;
    right.firstTriangle += left.triangleCount;
}

void fit(BvhNode& node, const Aabb& box)
{
    node.lowest = box.lowest;
    node.highest = box.highest;
}

Aabb boxOf(const BvhNode& node) { return {node.lowest, node.highest}; }

} // namespace

uint32_t bvhLeafCount(uint32_t triangleCount)
{
    return std::bit_ceil(std::max(1u, (triangleCount + shader::kBvhLeafTriangles - 1) / shader::kBvhLeafTriangles));
}

std::vector<BvhNode> bvhOf(std::span<const vec3> positions, std::span<const uint32_t> indices)
{
    check(indices.size() % 3 == 0, "three indices a triangle");
    const auto triangleCount = static_cast<uint32_t>(indices.size() / 3);
    const uint32_t leafCount = bvhLeafCount(triangleCount);
    std::vector<BvhNode> nodes(2 * size_t{leafCount});
    nodes[1].triangleCount = triangleCount;
    for (uint32_t node = 1; node < leafCount; ++node)
        halve(nodes, node);

    for (uint32_t node = 2 * leafCount - 1; node >= 1; --node) {
        Aabb box;
        if (node >= leafCount) {
            for (const uint32_t corner : indices.subspan(3 * size_t{nodes[node].firstTriangle}, 3 * size_t{nodes[node].triangleCount}))
                box.add(positions[corner]);
        } else {
            box.add(boxOf(nodes[2 * size_t{node}]));
            box.add(boxOf(nodes[2 * size_t{node} + 1]));
            nodes[node].firstTriangle = nodes[node].triangleCount = 0; // a leaf's only
        }
        fit(nodes[node], box);
    }
    return nodes;
}

} // namespace antumbra::render
