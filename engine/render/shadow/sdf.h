// Shadows that signed distance fields cast in the light of area lights, by cones (Ban, Balint, Valasek 2020, as corrected in
// methods/sdf-cones.md). The approximation: a light's share past the fields and its share past all else are taken for independent.
#pragma once

#include "render/fields.h"
#include "render/shadow/lit_frame.h"

#include <array>

namespace antumbra::render {

class FieldShadowSystem
{
public:
    explicit FieldShadowSystem(gpu::Device& device) : device_(&device) {}

    /// float[lightCount][pixels], the share of each light of the AreaBlock at `area` that is seen; absent without fields.
    graph::BufferRef declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const FieldFrame& fields, const GBuffer& g,
                             VkDeviceAddress area, uint32_t lightCount, const LitPixels& lit, graph::BufferRef& counters);
    /// Without area lights.
    static void skip(graph::FrameGraph& graph, std::string_view reason);

private:
    gpu::Device* device_;
    std::array<gpu::Pipeline, 5> pipelines_; // by the shader's METHOD, made when first asked for
};

} // namespace antumbra::render
