// Dear ImGui over the picture: this file draws what the panels asked for and owns the ImGui context; panels are built by the app.
// No window, no input of its own: the caller fills ImGui's io before begin().
#pragma once

#include "gpu/image.h"
#include "gpu/pipeline.h"
#include "graph/frame_graph.h"

struct ImGuiContext;

namespace antumbra::render {

class Overlay
{
public:
    /// Makes its ImGui context the current one.
    explicit Overlay(gpu::Device& device);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    /// Opens ImGui's frame for a picture of `extent` pixels, `seconds` after the last.
    void begin(uvec2 extent, float seconds);
    /// Closes it; the next rendered frame draws it, once. Makes font image and pipeline when there first is something to draw.
    void end();

    /// After Device::beginFrame. Draws what end() left onto `picture` (display values, sRGB-encoded) and returns its new version,
    /// or declares nothing: the plan says why.
    graph::ImageRef declare(graph::FrameGraph& graph, graph::ImageRef picture);

private:
    void makeDeviceParts();

    gpu::Device* device_;
    ImGuiContext* context_;
    gpu::Image font_;
    gpu::Pipeline pipeline_;
    bool isPending_ = false;
};

} // namespace antumbra::render
