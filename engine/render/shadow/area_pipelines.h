// The pipelines that shade by area lights, each made when first asked for, for what a frame has: nobody pays for the general case.
#pragma once

#include "render/fields.h"
#include "render/shadow/area_bodies.h"

#include <deque>

namespace antumbra::render {

/// Rays and the truth by rays, which know nothing of bodies before a light.
[[nodiscard]] bool traces(scene::LightShadow shadow);
/// Found as a share of the light, apart from it.
[[nodiscard]] bool isShare(scene::LightShadow shadow);

/// Of the arrays that a thread of area_shade.comp holds when it is compiled for these sizes; vectors of three take the room of four.
[[nodiscard]] uint32_t threadBytes(const AreaSizes& sizes);
/// The sizes that a shader is compiled for: few different ones, and with `occluders` of a pixel in closed form, fewer where its threads
/// would hold more than `mostBytes` otherwise (never less than one). What there is no room for is sampled, and counted.
[[nodiscard]] AreaSizes roomFor(const AreaSizes& asked, uint32_t mostBytes);

class AreaPipelines
{
public:
    explicit AreaPipelines(gpu::Device& device) : device_(&device) {}

    struct Variant
    {
        scene::LightShadow shadow;
        bool isGlossy;
        RayBackend backend; // Auto for what traces none
        AreaSizes sizes;    // of the frame; what traces rays does not depend on them
    };
    /// Rays meet fields, which others leave to shares. Stays where it is as others are made: passes hold on to it.
    const gpu::Pipeline& shade(const Variant& variant, const FieldFrame& fields);

private:
    struct Made
    {
        int shadow; // as the shader counts them
        bool isReference, hasTriangles, isGlossy;
        RayBackend backend;
        AreaSizes sizes;
        gpu::Pipeline pipeline;
    };

    gpu::Device* device_;
    std::deque<Made> made_;
};

} // namespace antumbra::render
