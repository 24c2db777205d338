#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/bvh.h"

// One group a tree: its leaves around the posed triangles, then level by level up to the root.
layout(local_size_x = 64) in;
const uint kGroupSize = 64u;

layout(buffer_reference, scalar) readonly buffer RestNodes { BvhNode node[]; };
layout(buffer_reference, scalar) coherent buffer Nodes { BvhNode node[]; };
layout(buffer_reference, scalar) readonly buffer Positions { vec3 position[]; };
layout(buffer_reference, scalar) readonly buffer Indices { uint index[]; };
layout(push_constant, scalar) uniform Push { BvhRefitDispatch pc; };

BvhNode fittedLeaf(BvhNode leaf)
{
    leaf.lowest = vec3(1.0e38);
    leaf.highest = vec3(-1.0e38);
    for (uint i = 3u * leaf.firstTriangle; i < 3u * (leaf.firstTriangle + leaf.triangleCount); ++i) {
        vec3 corner = Positions(pc.positions).position[Indices(pc.indices).index[i]];
        leaf.lowest = min(leaf.lowest, corner);
        leaf.highest = max(leaf.highest, corner);
    }
    return leaf;
}

void main()
{
    Nodes nodes = Nodes(pc.nodes);
    for (uint i = pc.leafCount + gl_LocalInvocationIndex; i < 2u * pc.leafCount; i += kGroupSize)
        nodes.node[i] = fittedLeaf(RestNodes(pc.rest).node[i]);
    for (uint first = pc.leafCount / 2u; first > 0u; first /= 2u) {
        memoryBarrierBuffer();
        barrier();
        for (uint i = first + gl_LocalInvocationIndex; i < 2u * first; i += kGroupSize) {
            BvhNode left = nodes.node[2u * i], right = nodes.node[2u * i + 1u];
            nodes.node[i] = BvhNode(min(left.lowest, right.lowest), 0u, max(left.highest, right.highest), 0u);
        }
    }
}
