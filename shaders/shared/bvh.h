// Bounding volume hierarchies that compute shaders trace where a device has no ray queries. Needs shared/occlusion.h for the masks.
#ifndef SHARED_BVH_H
#define SHARED_BVH_H

const uint kBvhLeafTriangles = 4u; // at most

// A tree over a mesh is perfect: `leafCount` is a power of two, the root is node 1, the children of node i are 2i and 2i + 1, the leaves
// are the last leafCount nodes. So a walk needs no stack, and a level is a range. Node 0 is none.
struct BvhNode
{
    vec3 lowest;
    uint firstTriangle; // of a leaf; else 0
    vec3 highest;
    uint triangleCount;
};

// A mesh in its place.
struct BvhInstance
{
    vec4 localFromWorld[3]; // rows
    uint64_t nodes; // BvhNode[2 * leafCount], local
    uint64_t positions; // vec3[], local
    uint64_t indices; // uint[], three a triangle
    vec3 lowest; // in the world
    uint leafCount;
    vec3 highest;
    uint mask; // kMaskStatic or kMaskDynamic
};

// What rays are traced through.
struct BvhScene
{
    uint64_t instances; // BvhInstance[instanceCount]
    uint instanceCount;
    uint padding;
};

// An instance on its way to the device, which alone knows the bounds of the pose.
struct BvhPlacement
{
    mat4 worldFromLocal;
    BvhInstance instance; // without bounds
};

struct BvhSceneDispatch
{
    uint64_t placements; // BvhPlacement[instanceCount]
    uint64_t instances; // BvhInstance[instanceCount], written
    uint64_t scene; // BvhScene, written
    uint instanceCount;
};

struct BvhRefitDispatch
{
    uint64_t rest; // BvhNode[2 * leafCount]: which triangles a leaf holds
    uint64_t nodes; // BvhNode[2 * leafCount], written
    uint64_t positions; // vec3[], posed
    uint64_t indices; // uint[]
    uint leafCount;
};

#endif
