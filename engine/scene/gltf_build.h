// From a parsed and checked glTF file to a Model: one step a function, in the order in which loadGltf takes them.
// Nothing here judges the file's form any more; what is left to refuse is what is too large or cannot be decoded.
#pragma once

#include "scene/model.h"

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace antumbra::scene {

/// Where the things of a glTF file ended up in the Model.
struct Placement
{
    std::vector<uint32_t> nodes;       // by glTF node: its place in Model::nodes
    std::vector<uint32_t> firstMorphs; // by glTF node: the first weight of its morph targets, or kNoIndex
};

/// All nodes of the file, parents before children.
void addNodes(Model& model, Placement& placement, const tinygltf::Model& file);
/// All materials, and those images that they show.
void addMaterials(Model& model, const tinygltf::Model& file);
/// The meshes of all nodes of the default scene, each with its joints and morph targets; triangles ordered in the rest pose.
void addMeshes(Model& model, Placement& placement, const tinygltf::Model& file);
/// All animations; channels that move nothing in the model are left out.
void addClips(Model& model, const Placement& placement, const tinygltf::Model& file);

/// A glTF primitive as a triangle list, every stream as long as `positions`.
struct TriangleList
{
    std::vector<vec3> positions;
    std::vector<vec3> normals;         // made flat where the file has none
    std::vector<vec2> uvs;             // those of the base colour texture, its transform applied
    std::vector<vec2> bakeUvs;         // TEXCOORD_1, or empty
    std::vector<Influence> influences; // into the skin's joints, or empty
    std::vector<uint32_t> indices;
    std::vector<std::vector<vec3>> morphPositions; // one a target, empty where the target does not move positions
    std::vector<std::vector<vec3>> morphNormals;
};

/// Empty for points, lines, and primitives without positions.
TriangleList readTriangles(const tinygltf::Model& file, const tinygltf::Primitive& primitive);

} // namespace antumbra::scene
