// The frame's constants on their way to the device: camera, environment in spherical harmonics, instances.
#pragma once

#include "bake/sh.h"
#include "render/frame_view.h"
#include "render/gpu_scene.h"
#include "render/shader_structs.h"

#include <optional>
#include <vector>

namespace antumbra::render {

/// Where this frame's blocks lie, for as long as the frame is recorded and run.
struct FrameAddresses
{
    uint32_t frame = 0;            // slot of the FrameBlock
    VkDeviceAddress instances = 0; // InstanceBlock[]: statics, then characters
};

class FrameBlocks
{
public:
    FrameBlocks(gpu::Device& device, const scene::Assets& assets);

    /// Writes the blocks into the frame's store. After GpuScene::prepare.
    FrameAddresses write(const FrameView& view, const GpuScene& scene, uvec2 extent);

private:
    const bake::ShFunction& projected(uint32_t environment);
    void writeEnvironment(shader::FrameBlock& block, const EnvironmentView& environment, const GpuScene& scene);

    gpu::Device* device_;
    const scene::Assets* assets_;
    gpu::Buffer blocks_[gpu::kFramesInFlight];
    std::vector<std::optional<bake::ShFunction>> projections_; // one an environment, made when asked for
};

} // namespace antumbra::render
