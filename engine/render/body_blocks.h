// Convex bodies packed as shaders read them (shaders/shared/area.h). Keeps memory from frame to frame; owns nothing on a device.
#pragma once

#include "render/shader_structs.h"
#include "scene/convex_body.h"

#include <vector>

namespace antumbra::render {

struct BodyBlocks
{
    std::vector<shader::BodyBlock> bodies;
    std::vector<vec3> vertices; // world
    std::vector<shader::FaceBlock> faces;
    std::vector<uint32_t> corners;
    std::vector<shader::EdgeBlock> edges;

    /// The index of the body, moved by `toWorld`. `flags` are shader::kBody..., but for kBodyPlanar, which the body tells. The body has
    /// less than 65535 vertices and faces.
    uint32_t add(const scene::ConvexBody& body, const mat4& toWorld = mat4{1}, uint32_t flags = 0, float margin = 0);
    void clear();
};

} // namespace antumbra::render
