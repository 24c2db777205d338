// How much of area lights is seen by the ratio of two stochastic terms, the light past what hides it over the whole, both denoised alike
// (Heitz, Hill, McGuire 2018, "Combining Analytic Direct Illumination and Stochastic Shadows"). What is not hidden stays free of noise. The
// approximations are the filter and one ratio for all colours that are reflected.
#pragma once

#include "render/shadow/lit_frame.h"

#include <array>

namespace antumbra::render {

class RatioShadowSystem
{
public:
    explicit RatioShadowSystem(gpu::Device& device) : device_(&device) {}

    /// vec2[lights][pixels]: shares of each light of the range that are seen, as it is reflected diffusely and by GGX.
    graph::BufferRef declare(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range);
    static void skip(graph::FrameGraph& graph, std::string_view reason);

private:
    const gpu::Pipeline& tracePipeline(RayBackend backend, bool isGlossy);
    graph::BufferRef declareTrace(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range);
    graph::BufferRef declareDenoise(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range, graph::BufferRef samples,
                                    int spacing, bool isLast);

    gpu::Device* device_;
    std::array<gpu::Pipeline, 4> trace_;   // by back-end and whether glossy, each made when first asked for
    std::array<gpu::Pipeline, 2> denoise_; // by whether it is the last
};

} // namespace antumbra::render
