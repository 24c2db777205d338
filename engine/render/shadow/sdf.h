// Shadows that signed distance fields cast in the light of area lights, by cones (Ban, Balint, Valasek 2020, as corrected in
// methods/sdf-cones.md): towards spheres, or towards cells of what has an outline. The approximation: a light's share past the fields and
// its share past all else are taken for independent.
#pragma once

#include "render/fields.h"
#include "render/shadow/lit_frame.h"

#include <deque>
#include <string>

namespace antumbra::render {

class FieldShadowSystem
{
public:
    explicit FieldShadowSystem(gpu::Device& device) : device_(&device) {}

    /// float[lights][pixels], the share of each light of the frame's AreaBlock that is seen; absent without fields, and where rays find all
    /// of it.
    graph::BufferRef declare(graph::FrameGraph& graph, const LitFrame& frame, const FieldFrame& fields,
                             std::span<const AreaLightRange> ranges, graph::BufferRef& counters);
    /// Without area lights.
    static void skip(graph::FrameGraph& graph, std::string_view reason);

private:
    struct Made
    {
        std::string structure;
        uint32_t method; // of the shader
        bool hasOutlines, hasBones;
        gpu::Pipeline pipeline;
    };
    const gpu::Pipeline& pipelineFor(std::string_view structure, uint32_t method, bool hasOutlines, bool hasBones);

    gpu::Device* device_;
    std::deque<Made> pipelines_; // each made when first asked for
};

} // namespace antumbra::render
