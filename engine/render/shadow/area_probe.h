// One pixel of area light taken apart: outlines, silhouettes and what is left of the lights, as lines to draw. Draws none; off it costs
// nothing.
#pragma once

#include "render/gbuffer.h"

#include <optional>
#include <span>
#include <vector>

namespace antumbra::render {

class AreaProbeSystem
{
public:
    explicit AreaProbeSystem(gpu::Device& device) : device_(&device) {}

    /// Once a frame, after Device::beginFrame: takes what the slot's last frame found.
    void beginFrame();
    /// `area` is the address of the frame's AreaBlock. `pixel` is in the picture. What is not of the picture is not asked for.
    void declare(graph::FrameGraph& graph, uint32_t slot, const GBuffer& g, VkDeviceAddress area, ivec2 pixel, uint32_t mostPlanes);

    /// Of the newest finished frame; none where it asked for none.
    [[nodiscard]] std::span<const shader::ProbeLine> lines() const { return lines_; }

private:
    struct Slot
    {
        gpu::Buffer lines;
        bool isPending = false;
    };

    gpu::Device* device_;
    gpu::Pipeline pipeline_;
    gpu::Buffer scratch_;
    Slot slots_[gpu::kFramesInFlight];
    std::vector<shader::ProbeLine> lines_;
};

} // namespace antumbra::render
