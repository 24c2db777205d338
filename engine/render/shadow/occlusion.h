// Environment light that moving objects and distance fields hide, by conical ray culling (Xu et al. 2022, eq. 3-5 and 8;
// methods/conical-culling.md).
// Noise is left to the filter; the approximation is the environment's spherical harmonics.
#pragma once

#include "render/gbuffer.h"
#include "render/shadow/ground.h"
#include "render/shadow/occlusion_pipelines.h"

namespace antumbra::render {

/// Irradiance that is hidden, where it was traced, with the surface it belongs to (lib/traced.glsl).
struct Traced
{
    graph::ImageRef pixels;  // absent where nothing hides light
    uint32_t pixelScale = 1; // of the image to the G-buffer: 1, 2, 4
};

class OcclusionSystem
{
public:
    explicit OcclusionSystem(gpu::Device& device) : device_(&device), trace_(device) {}

    Traced declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const FieldFrame& fields,
                   const Baked& baked, const Grounds& grounds, const GBuffer& g, const Posed& posed, graph::BufferRef& counters);

private:
    void prepare(const OcclusionKnobs& knobs);
    graph::ImageRef declareTrace(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene,
                                 const FieldFrame& fields, const Baked& baked, const Grounds& grounds, const GBuffer& g, const Posed& posed,
                                 graph::BufferRef& counters);
    graph::ImageRef declareFilter(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GBuffer& g,
                                  graph::ImageRef traced);

    gpu::Device* device_;
    OcclusionPipelines trace_;
    gpu::Pipeline filter_;
    gpu::Buffer samples_;
    uint32_t sampleCount_ = 0;
};

} // namespace antumbra::render
