// First term minus occluded irradiance, times albedo over pi; the environment behind it; and the views that explain the picture.
#pragma once

#include "render/gbuffer.h"

namespace antumbra::render {

struct Composed
{
    graph::ImageRef color;      // W/(m^2 sr)
    graph::ImageRef irradiance; // W/m^2; absent unless asked for
};

class CompositeSystem
{
public:
    explicit CompositeSystem(gpu::Device& device);

    /// `occluded` and `reference` may be absent.
    Composed declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GBuffer& g, graph::ImageRef occluded,
                     graph::ImageRef reference, graph::BufferRef& counters, bool wantsIrradiance);

private:
    gpu::Device* device_;
    gpu::Pipeline final_;
    gpu::Pipeline explaining_; // made when a view first asks for it
    gpu::Pipeline sky_;
};

} // namespace antumbra::render
