// The frame's constants on their way to the device: the camera, and the environment in spherical harmonics, windowed where it lights what
// is baked.
#pragma once

#include "bake/sh.h"
#include "render/frame_view.h"
#include "render/gpu_scene.h"
#include "render/shader_structs.h"

#include <optional>
#include <vector>

namespace antumbra::render {

/// Reversed depth without a far plane: clip z = near, w = the view depth in metres. Y points down in Vulkan's clip space.
mat4 clipFromWorld(const CameraView& camera, uvec2 extent);

class FrameBlocks
{
public:
    FrameBlocks(gpu::Device& device, const scene::Assets& assets);

    /// Returns the slot of this frame's FrameBlock. After GpuScene::prepare; `baked` is what PrtSystem::prepare returned.
    uint32_t write(const FrameView& view, const GpuScene& scene, const shader::BakedLight& baked, uvec2 extent);
    [[nodiscard]] const shader::FrameBlock& newest() const { return newest_; }

private:
    const bake::ShFunction& projected(uint32_t environment);
    void writeEnvironment(const FrameView& view, const GpuScene& scene);

    gpu::Device* device_;
    const scene::Assets* assets_;
    gpu::Buffer blocks_[gpu::kFramesInFlight];
    shader::FrameBlock newest_{};
    std::vector<std::optional<bake::ShFunction>> projections_; // one an environment, made when asked for
};

} // namespace antumbra::render
