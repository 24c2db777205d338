// A character as a few capsules, one a bone: what stands for its skin where shadows may be cheap.
#pragma once

#include "scene/model.h"

#include <vector>

namespace antumbra::scene {

/// In bind space: joint `joint` moves it. Radius in the units of the model.
struct BoneCapsule
{
    uint32_t joint = 0; // into Model::joints
    vec3 a{0}, b{0};
    float radius = 0;
};

/// Each as near as can be, by least squares over the surface, to the triangles that belong to its joint (scene/triangle_joints.h): a part
/// of them lies outside. In the order of the joints; joints whose triangles have no area are left out. Morph targets are not looked at.
std::vector<BoneCapsule> boneCapsules(const Model& model);

} // namespace antumbra::scene
