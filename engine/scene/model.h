// A glTF file as the engine takes it: one mesh, the nodes that move it, clips, materials. Every vertex hangs on joints,
// so a rigid part is a skin of one joint and skinned, rigid and morphed parts are posed by the same code.
#pragma once

#include "base/math.h"
#include "scene/images.h"
#include "scene/mesh.h"

#include <string>
#include <vector>

namespace antumbra::scene {

/// How a picture goes on beyond its edge.
enum class Wrap { Repeat, Mirror, Clamp };

struct Material
{
    vec3 albedo{0.8f}; // linear
    float alpha = 1;
    float alphaCutoff = 0; // 0: opaque
    float roughness = 1;
    float metallic = 0;
    float specular = 1; // scale of the dielectric reflection; 0: pure Lambert
    vec3 emission{0};   // W/(m^2 sr)
    bool twoSided = false;
    uint32_t albedoImage = kNoIndex;            // into Model::images, sRGB; filtered trilinearly whatever the file says
    uint32_t metallicRoughnessImage = kNoIndex; // G roughness, B metallic, linear
    Wrap wrapU = Wrap::Repeat;                  // of both images, as they share their coordinates
    Wrap wrapV = Wrap::Repeat;
};

/// Local translation, rotation, scale.
struct NodePose
{
    vec3 translation{0};
    quat rotation{1, 0, 0, 0};
    vec3 scale{1};
};

struct Node
{
    std::string name;
    uint32_t parent = kNoIndex; // always before the node itself in Model::nodes
    NodePose rest;
};

/// A vertex is moved by nodeToModel[node] * inverseBind.
struct Joint
{
    uint32_t node = 0;
    mat4 inverseBind{1};
};

enum class Interpolation { Step, Linear, Cubic };
enum class Channel { Translation, Rotation, Scale, MorphWeights };

struct Track
{
    Channel channel = Channel::Translation;
    uint32_t target = 0; // node; for MorphWeights: the first morph weight
    uint32_t width = 3;  // floats a value: 3, 4 (xyzw), or the number of weights
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> times;  // seconds, not decreasing
    std::vector<float> values; // width a key; Cubic: in-tangent, value, out-tangent
};

struct Clip
{
    std::string name;
    float duration = 0; // seconds
    std::vector<Track> tracks;
};

struct Model
{
    std::string name;
    Mesh mesh;
    std::vector<Node> nodes;             // parents before children
    std::vector<Joint> joints;           // at least one
    std::vector<float> restMorphWeights; // one a morph target
    std::vector<Material> materials;
    std::vector<Image8> images;
    std::vector<Clip> clips;
};

/// A model of one rigid part.
Model rigidModel(std::string name, Mesh mesh, const Material& material);

} // namespace antumbra::scene
