// Environment light that moving objects hide, by conical ray culling (Xu et al. 2022, eq. 3-5 and 8; methods/conical-culling.md).
// Noise is left to the filter; the approximation is the environment's spherical harmonics.
#pragma once

#include "render/gbuffer.h"

#include <array>

namespace antumbra::render {

class OcclusionSystem
{
public:
    explicit OcclusionSystem(gpu::Device& device) : device_(&device) {}

    /// The occluded irradiance in W/m^2 at the G-buffer's extent, cones a pixel in a; absent where nothing moves.
    graph::ImageRef declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const GBuffer& g,
                            const Posed& posed, graph::BufferRef& counters);

private:
    void prepare(const OcclusionKnobs& knobs);
    graph::ImageRef declareTrace(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const GBuffer& g,
                                 const Posed& posed, graph::BufferRef& counters);
    graph::ImageRef declareFilter(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GBuffer& g,
                                  graph::ImageRef traced);
    graph::ImageRef declareUpsample(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GBuffer& g,
                                    graph::ImageRef coarse);

    gpu::Device* device_;
    std::array<gpu::Pipeline, 4> trace_; // by Culling, each made when first asked for
    gpu::Pipeline filter_, upsample_;
    gpu::Buffer samples_, masks_;
    uint32_t sampleCount_ = 0; // of both
};

} // namespace antumbra::render
