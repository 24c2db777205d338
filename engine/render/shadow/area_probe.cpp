#include "render/shadow/area_probe.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace antumbra::render {

namespace {

using graph::Use;

constexpr size_t kLineBytes = sizeof(uint32_t) + shader::kMostProbeLines * sizeof(shader::ProbeLine);

} // namespace

void AreaProbeSystem::beginFrame()
{
    Slot& slot = slots_[device_->frameSlot()];
    lines_.clear();
    if (!std::exchange(slot.isPending, false))
        return;
    uint32_t count = 0;
    std::memcpy(&count, slot.lines.mapped(), sizeof(count));
    lines_.resize(std::min(count, shader::kMostProbeLines));
    std::memcpy(lines_.data(), slot.lines.mapped() + sizeof(count), lines_.size() * sizeof(shader::ProbeLine));
}

void AreaProbeSystem::declare(graph::FrameGraph& graph, uint32_t frame, const GBuffer& g, VkDeviceAddress area, ivec2 pixel,
                              uint32_t mostPlanes)
{
    if (!pipeline_) {
        pipeline_ = computePipeline(*device_, "area_probe.comp");
        scratch_ = gpu::Buffer(*device_, "area probe scratch", shader::kProbeScratchBytes);
        for (Slot& slot : slots_)
            slot.lines = gpu::Buffer(*device_, "area probe", kLineBytes, gpu::MemoryKind::Readback);
    }
    Slot& slot = slots_[device_->frameSlot()];
    slot.isPending = true;
    graph::Pass pass = graph.add("area probe");
    for (const graph::ImageRef image : {g.depth, g.normals, g.albedo})
        pass.read(image, Use::Sampled);
    const graph::BufferRef lines =
        pass.write(graph.importBuffer("area probe", kLineBytes, graph::importedBuffer(slot.lines)), Use::StorageWrite);
    // Frames take turns with the scratch.
    const graph::BufferRef scratch =
        pass.write(graph.importBuffer("area probe scratch", shader::kProbeScratchBytes, graph::importedBuffer(scratch_), Use::StorageWrite),
                   Use::StorageWrite);
    pass.record([this, frame, g, area, pixel, mostPlanes, lines, scratch](graph::Recorder& recorder) {
        recorder.dispatch(pipeline_,
                          shader::AreaProbe{.area = area,
                                            .lines = recorder.address(lines),
                                            .scratch = recorder.address(scratch),
                                            .frame = frame,
                                            .depth = recorder.sampled(g.depth),
                                            .normals = recorder.sampled(g.normals),
                                            .albedo = recorder.sampled(g.albedo),
                                            .mostPlanes = static_cast<int>(mostPlanes),
                                            .pixel = pixel},
                          {1, 1}, {1, 1});
    });
    graph.output(lines, Use::HostRead);
}

} // namespace antumbra::render
