// One case of kind `area` (golden/README.md) as convex bodies: a light, what stands before it, and the lobe that receives it.
#pragma once

#include "app/eval_cases.h"
#include "gpu/buffer.h"
#include "gpu/pipeline.h"
#include "render/body_blocks.h"

namespace antumbra::app {

struct AreaOccluder
{
    scene::ConvexBody body;
    bool isFrontOnly = false; // a triangle of a closed mesh
};

struct AreaProblem
{
    vec3 position{0};
    vec3 normal{0, 0, 1};
    vec3 tangent{1, 0, 0};
    std::array<vec3, 3> lobe{}; // rows of M^-1, which takes (tangent, bitangent, normal) to the lobe's space
    scene::ConvexBody light;
    bool isTwoSided = false;
    std::vector<AreaOccluder> occluders; // meshes that are not convex as their triangles
};

/// Throws Error that names the place in the file where the case is malformed.
AreaProblem areaProblemOf(const EvalCase& from);

/// As shaders/eval_area.comp takes it; its bodies are added, moved by `toWorld`, which moves nothing else.
shader::AreaCase deviceCase(const AreaProblem& problem, render::BodyBlocks& bodies, const mat4& toWorld = mat4{1});

/// shaders/eval_area.comp as this device takes it, and what it needs beside `count` cases; empty where threads have room of their own.
gpu::Pipeline areaPipeline(gpu::Device& device);
gpu::Buffer areaScratch(gpu::Device& device, size_t count);

} // namespace antumbra::app
