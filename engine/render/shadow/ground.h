// The ground below characters in baked light: what it does not send up because they shadow it, which the occlusion passes take away from
// what comes from below. Of baked light itself it changes nothing; distance fields shadow no ground.
#pragma once

#include "render/gpu_scene.h"
#include "render/posing.h"
#include "render/shadow/prt.h"

#include <array>

namespace antumbra::render {

/// GroundBlock[count], one a character; absent without baked light or characters.
struct Grounds
{
    graph::BufferRef blocks;
    uint32_t count = 0;

    explicit operator bool() const { return static_cast<bool>(blocks); }
};

class GroundSystem
{
public:
    explicit GroundSystem(gpu::Device& device) : device_(&device) {}

    Grounds declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const Baked& baked,
                    const Posed& posed);

private:
    [[nodiscard]] const gpu::Pipeline& pipeline(RayBackend backend);

    gpu::Device* device_;
    std::array<gpu::Pipeline, 2> shadow_; // by backend, each made when first asked for
};

} // namespace antumbra::render
