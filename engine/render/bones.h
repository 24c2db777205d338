// Which triangles a bone bounds, and along which axis: the part of the outer capsules that does not change with the pose.
#pragma once

#include "render/shader_structs.h"
#include "scene/model.h"

#include <vector>

namespace antumbra::render {

/// Every triangle belongs to the bone that moves its corners most. The device sets each bone's radius from the posed corners
/// (bone_fit.comp), so the capsules hold the whole mesh in every pose.
struct Bones
{
    std::vector<shader::BoneBlock> blocks;
    std::vector<uint32_t> vertices; // corners, each once a bone
};

Bones bonesOf(const scene::Model& model);

} // namespace antumbra::render
