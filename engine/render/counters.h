// Counters that shaders add to: cleared by the device each frame, read by the host when the frame is done.
#pragma once

#include "graph/executor.h"
#include "render/shader_structs.h"

namespace antumbra::render {

class Counters
{
public:
    explicit Counters(gpu::Device& device);

    /// After Device::beginFrame: takes what the slot's last frame counted.
    void beginFrame();
    /// The buffer of this frame, cleared.
    graph::BufferRef declareClear(graph::FrameGraph& graph);
    void declareReadback(graph::FrameGraph& graph, graph::BufferRef counters);

    [[nodiscard]] const shader::CounterBlock& newest() const { return newest_; }

private:
    gpu::Device* device_;
    gpu::Buffer counters_;
    gpu::Buffer readbacks_[gpu::kFramesInFlight];
    shader::CounterBlock newest_{};
};

} // namespace antumbra::render
