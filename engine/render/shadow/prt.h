// Baked light at run time (Sloan et al. 2002; Xu et al. 2022, eq. 6): the atlas and the irradiance volume on the device, lit anew in the
// frames in which the environment's light changed and in no other. Bakes nothing, and draws nothing.
#pragma once

#include "graph/executor.h"
#include "render/frame_view.h"
#include "render/shader_structs.h"

#include <optional>

namespace antumbra::render {

/// Handles behind which the frame's baked light stands, where the frame block says; absent without a bake.
struct Baked
{
    graph::BufferRef texels; // of the atlas
    graph::BufferRef cells;  // of the irradiance volume

    explicit operator bool() const { return static_cast<bool>(texels); }
};

class PrtSystem
{
public:
    explicit PrtSystem(gpu::Device& device) : device_(&device) {}

    /// Makes what the bake needs on the device and drops what another one needed. Returns what the frame block says of it.
    shader::BakedLight prepare(const bake::Bake* bake);
    /// After prepare(). `frame` is the slot of `light`, whose radiance has the bake's bands at least.
    Baked declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const shader::FrameBlock& light);

private:
    struct OnDevice
    {
        const bake::Bake* bake;
        gpu::Pipeline prtRelight, volumeRelight;
        gpu::Buffer transfers, texels, matrices, cells;
        std::optional<std::array<vec3, shader::kMostShCoefficients>> litBy; // nothing: not lit yet
    };

    [[nodiscard]] OnDevice made(const bake::Bake& bake) const;
    void declareAtlas(graph::FrameGraph& graph, uint32_t frame, Baked& baked) const;
    void declareVolume(graph::FrameGraph& graph, uint32_t frame, Baked& baked) const;

    gpu::Device* device_;
    std::optional<OnDevice> held_;
};

} // namespace antumbra::render
