// Meshes, materials and instances as the device holds them.
#ifndef SHARED_SCENE_H
#define SHARED_SCENE_H

const uint kNoImage = 0xffffffffu;

struct MaterialBlock
{
    vec3 albedo; // linear
    float alphaCutoff; // 0: opaque
    float alpha;
    float roughness;
    float metallic;
    float specular;
    uint albedoImage;
    uint metallicRoughnessImage;
};

const uint kInstanceDynamic = 1u;

struct InstanceBlock
{
    mat4 worldFromLocal;
    mat4 normalFromLocal; // inverse transpose, upper 3x3
    uint64_t positions; // vec3[], local
    uint64_t normals; // vec3[]
    uint64_t uvs; // vec2[]
    uint64_t triangleMaterials; // uint[]: into materials
    uint64_t materials; // MaterialBlock[]
    uint flags;
    uint padding;
};

// Push constants of the G-buffer.
struct GBufferDraw
{
    uint64_t instance; // InstanceBlock
    uint frame; // slot of a FrameBlock
};

#endif
