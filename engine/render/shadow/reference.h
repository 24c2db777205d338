// The truth beside the occlusion pass: the same integral with no culling and no filter, accumulated over frames while nothing changes.
#pragma once

#include "render/gbuffer.h"
#include "render/shadow/ground.h"
#include "render/shadow/occlusion_pipelines.h"

#include <optional>

namespace antumbra::render {

class ReferenceSystem
{
public:
    explicit ReferenceSystem(gpu::Device& device) : device_(&device), trace_(device) {}

    /// The occluded irradiance so far, W/m^2; absent unless knobs.reference.samples or the view asks for it.
    graph::ImageRef declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene,
                            const FieldFrame& fields, const Baked& baked, const Grounds& grounds, const GBuffer& g, const Posed& posed);
    /// Accumulated for the view as it stands; none where nothing is asked for, or nothing can be hidden.
    [[nodiscard]] std::optional<uint32_t> samples() const { return isActive_ ? std::optional(frames_ * samplesAFrame_) : std::nullopt; }

private:
    gpu::Device* device_;
    OcclusionPipelines trace_;
    gpu::Pipeline accumulate_;
    graph::HistorySlot history_;
    uint64_t seen_ = 0;
    bool isActive_ = false;
    uint32_t frames_ = 0;
    uint32_t samplesAFrame_ = 0;
};

} // namespace antumbra::render
