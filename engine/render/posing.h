// Characters into their pose: skinning, the bounds of what came out, acceleration structures. A pose that did not change costs nothing;
// when many change, the oldest go first and the rest wait a frame, wholly: picture and shadow of a character always agree.
#pragma once

#include "graph/executor.h"
#include "render/gpu_scene.h"

#include <vector>

namespace antumbra::render {

/// Handles behind which the frame's poses stand; absent without characters.
struct Posed
{
    graph::BufferRef vertices; // every character's posed streams
    graph::BufferRef bounds;   // BlockerBlock[] and CapsuleBlock[] in the world
    graph::BufferRef scene;    // the top-level acceleration structure
};

class PosingSystem
{
public:
    explicit PosingSystem(gpu::Device& device) : device_(&device) {}

    Posed declare(graph::FrameGraph& graph, const FrameView& view, GpuScene& scene);

private:
    void makePipelines();
    void choose(const FrameView& view, GpuScene& scene);
    void declareSkinning(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed);
    void declareBuilds(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed);
    void declareBounds(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed);

    gpu::Device* device_;
    gpu::Pipeline skinning_, boneFit_, sphereFit_, blockers_;
    std::vector<uint32_t> chosen_; // into FrameView::characters: posed anew this frame
};

} // namespace antumbra::render
