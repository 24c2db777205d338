// How much of area lights is seen, from one ray a pixel to a light's middle and a search for the shadow's border on the screen
// (methods/penumbra.md): as in Kissner's article, or on both sides of the border. The cost is the screen's, whatever the scene. Approximate
// in all: lights are disks, borders are straight, and what is hidden from the eye or off the screen has none.
#pragma once

#include "render/shadow/lit_frame.h"

#include <array>

namespace antumbra::render {

class PenumbraSystem
{
public:
    explicit PenumbraSystem(gpu::Device& device) : device_(&device) {}

    /// vec2[lights][pixels]: shares of each light of the range that are seen, twice the same number.
    graph::BufferRef declare(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range);
    static void skip(graph::FrameGraph& graph, std::string_view reason);

private:
    graph::BufferRef declareTrace(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range);
    graph::BufferRef declareSearch(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range, graph::BufferRef rays);

    gpu::Device* device_;
    std::array<gpu::Pipeline, 2> trace_;  // by back-end, each made when first asked for
    std::array<gpu::Pipeline, 2> search_; // by whether two-sided
};

} // namespace antumbra::render
