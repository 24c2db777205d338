// Area lights and what stands before them, as convex bodies.
#ifndef SHARED_AREA_H
#define SHARED_AREA_H

const uint kNoFace = 0xffffu;

const uint kBodyPlanar = 1u; // one polygon, no inside
const uint kBodyTwoSided = 2u; // a planar light shines to both sides; what blocks does so from both
const uint kBodyFrontOnly = 4u; // a triangle of a closed mesh: the side that is seen blocks

// A convex polyhedron or polygon. What is counted from its first is indexed relative to it.
struct BodyBlock
{
    vec3 centre; // of a sphere around it
    float radius;
    uint firstVertex;
    uint vertexCount;
    uint firstFace;
    uint faceCount;
    uint firstEdge;
    uint edgeCount;
    uint flags;
};

struct FaceBlock
{
    vec3 normal; // outward, unit; zero where the face has no area
    uint firstCorner; // of its loop, counter-clockwise seen from outside
    uint cornerCount;
};

// From a to b as in the loop of the face `left`; `right` is kNoFace where there is none.
struct EdgeBlock
{
    uint vertices; // a, b << 16
    uint faces; // left, right << 16
};

// Where bodies lie.
struct BodyArrays
{
    uint64_t bodies; // BodyBlock[]
    uint64_t vertices; // vec3[], world
    uint64_t faces; // FaceBlock[]
    uint64_t corners; // uint[], into the body's vertices
    uint64_t edges; // EdgeBlock[]
};

#endif
