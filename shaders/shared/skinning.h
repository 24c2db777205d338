// Posing a mesh on the device, and the bounds of what came out.
#ifndef SHARED_SKINNING_H
#define SHARED_SKINNING_H

struct InfluenceBlock
{
    uint joints01; // 16 bits each
    uint joints23;
    vec4 weights;
};

// Offsets of vertices [firstVertex, firstVertex + count); `positions` and `normals` index into one array of vec3.
struct MorphBlock
{
    uint firstVertex;
    uint count;
    uint positions;
    uint normals; // kNoNormals: none
};

const uint kNoNormals = 0xffffffffu;

struct SkinningDispatch
{
    uint64_t bindPositions; // vec3[vertexCount]
    uint64_t bindNormals;
    uint64_t influences; // InfluenceBlock[vertexCount]
    uint64_t joints; // mat4[]
    uint64_t morphs; // MorphBlock[morphCount]
    uint64_t morphOffsets; // vec3[]
    uint64_t morphWeights; // float[morphCount]
    uint64_t posedPositions; // vec3[vertexCount], written
    uint64_t posedNormals; // written
    uint vertexCount;
    uint morphCount;
};

// The vertices of the triangles that a bone bounds, and the bone's axis in bind space.
struct BoneBlock
{
    vec3 a;
    uint firstVertex; // into the bone vertex list
    vec3 b;
    uint vertexCount;
    uint joint;
};

// Bounds of a posed character, in its own space or in the world's.
struct CapsuleBlock
{
    vec3 middle;
    float radius;
    vec3 arm; // from the middle to one end of the axis; the other end lies as far the other way
    float reach; // the radius of the sphere about the middle that holds the capsule
};

struct SphereBlock
{
    vec3 centre;
    float radius;
};

struct BoneFitDispatch
{
    uint64_t posedPositions;
    uint64_t joints; // mat4[]
    uint64_t bones; // BoneBlock[boneCount]
    uint64_t boneVertices; // uint[]
    uint64_t capsules; // CapsuleBlock[boneCount], written
};

struct SphereFitDispatch
{
    uint64_t posedPositions;
    uint64_t capsules; // CapsuleBlock[boneCount]
    uint64_t sphere; // SphereBlock, written
    uint vertexCount;
    uint boneCount;
};

#endif
