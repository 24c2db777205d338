// From clips to joint matrices: sampling, cross-fading, and the walk down the node tree. Allocates nothing once warm.
#pragma once

#include "scene/model.h"

#include <span>

namespace antumbra::scene {

/// What clips move: a local pose a node and a weight a morph target.
struct LocalPose
{
    std::vector<NodePose> nodes;
    std::vector<float> morphWeights;
};

void setRest(LocalPose& pose, const Model& model);
/// Overwrites what the clip's tracks move and leaves the rest. `seconds` is clamped to the tracks' keys; looping is the caller's business.
void sample(LocalPose& pose, const Clip& clip, float seconds);
/// `pose` moves the share 0..1 of the way towards `towards` (rotations along the shorter arc).
void blend(LocalPose& pose, const LocalPose& towards, float share);
/// Model-space matrices, one a joint: nodeToModel * inverseBind. `nodeToModel` is scratch. Finite for every finite pose.
void resolve(std::span<mat4> jointMatrices, std::vector<mat4>& nodeToModel, const LocalPose& pose, const Model& model);

/// Poses the mesh on the CPU: what the skinning shader does, for loading static models and for tests.
/// Normals turn by the cofactors of the joint matrix, so that mirrored and flattened parts keep facing outwards.
Mesh posedMesh(const Model& model, std::span<const mat4> jointMatrices, std::span<const float> morphWeights);
/// The mesh as it stands in the rest pose: static models, bounds.
Mesh restMesh(const Model& model);

} // namespace antumbra::scene
