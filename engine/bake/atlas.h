// A second set of texture coordinates, over one page, for everything whose light is baked: the file's own where it is sound, else charts
// of our own. The same input gives the same atlas, so that no file has to hold it. Knows nothing of light.
#pragma once

#include "scene/model.h"

#include <span>
#include <vector>

namespace antumbra::bake {

struct AtlasSettings
{
    float texelsPerMetre = 8;   // of the world; above 0
    uint32_t mostTexels = 2048; // along a side; 4 at least
};

struct AtlasObject
{
    const scene::Model* model = nullptr;
    mat4 world{1};
};

struct Atlas
{
    uvec2 extent{0};          // texels, multiples of four
    float texelsPerMetre = 0; // what fitted: at most what was asked
    /// One an object, as it is to be drawn and traced, at rest and in the model's space: bakeUvs in 0..1 over the page; vertices are
    /// split at seams, triangles of two-sided materials stand there a second time, turned over. Triangles without area are left out.
    std::vector<scene::Mesh> meshes;
};

/// Charts grown by the deviation of normals, at an even density of texels in the world. Every chart covers a texel at least, and two texels
/// lie free between any two charts: one next to either, so that bilinear look-ups of one never read what is next to the other. The order of
/// triangles and vertices in a mesh changes nothing. Throws Error that names the density that would fit when the page is full at any
/// density worth having.
Atlas layOut(std::span<const AtlasObject> objects, const AtlasSettings& settings);

/// Why TEXCOORD_1 cannot be baked over: outside 0..1, triangles that overlap or have no area there. Null where it can.
const char* faultOfBakeUvs(const scene::Mesh& mesh);

} // namespace antumbra::bake
