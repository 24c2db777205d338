// From radiance to display values (Khronos PBR Neutral, sRGB).
#pragma once

#include "graph/executor.h"
#include "render/frame_view.h"

namespace antumbra::render {

class TonemapSystem
{
public:
    explicit TonemapSystem(gpu::Device& device);

    /// Writes `picture` and returns its new version.
    graph::ImageRef declare(graph::FrameGraph& graph, const FrameView& view, graph::ImageRef color, graph::ImageRef picture) const;

private:
    gpu::Pipeline pipeline_;
};

} // namespace antumbra::render
