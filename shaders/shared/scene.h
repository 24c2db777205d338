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

const uint kDrawDynamic = 1u;

// Triangles of one material in one place: push constants of the G-buffer, which all threads read alike.
struct GBufferDraw
{
    vec4 worldFromLocal[3]; // rows
    MaterialBlock material;
    uint64_t positions; // vec3[], local
    uint64_t normals; // vec3[]
    uint64_t uvs; // vec2[]
    uint64_t bakeUvs; // vec2[], of what is baked
    uint frame; // slot of a FrameBlock
    uint flags;
};

// The body of an area light.
struct LightBodyDraw
{
    vec4 worldFromLocal[3]; // rows
    uint64_t positions; // vec3[], local
    uint64_t normals; // vec3[]
    vec3 radiance; // W/(m^2 sr)
    float exposure;
    uint frame; // slot of a FrameBlock
    uint isTwoSided;
};

#endif
