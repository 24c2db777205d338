// Dear ImGui over the picture: this file draws what the panels asked for and owns the ImGui context; panels are built by the app.
// No window, no input of its own: the caller fills ImGui's io before begin().
#pragma once

#include "gpu/image.h"
#include "gpu/pipeline.h"
#include "graph/frame_graph.h"

#include <memory>

struct ImGuiContext;

namespace antumbra::render {

class Overlay
{
public:
    explicit Overlay(gpu::Device& device);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    /// Opens ImGui's frame for a picture of `extent` pixels, `seconds` after the last. Makes font image and pipeline at first use.
    void begin(uvec2 extent, float seconds);
    /// Closes it; the next rendered frame draws it, once.
    void end();

    /// Draws what end() left, or declares nothing (the plan says why).
    graph::ImageRef declare(graph::FrameGraph& graph, graph::ImageRef picture);

private:
    void makeDeviceParts();

    gpu::Device* device_;
    ImGuiContext* context_ = nullptr;
    gpu::Image font_;
    gpu::Pipeline pipeline_;
    gpu::Buffer vertices_[gpu::kFramesInFlight], indices_[gpu::kFramesInFlight];
    bool isPending_ = false;
};

} // namespace antumbra::render
