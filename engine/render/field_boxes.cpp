#include "render/field_boxes.h"

#include "render/frame_copy.h"

#include <algorithm>
#include <bit>

namespace antumbra::render {

namespace {

using graph::Use;

/// What shaders round shall not be missed.
VkAabbPositionsKHR boxAbout(const shader::FieldGroupBlock& group)
{
    const vec3 half = 1.00001f * (group.halfEdges + group.melt / group.slope) + 1e-6f * glm::abs(group.centre);
    const vec3 lowest = group.centre - half, highest = group.centre + half;
    return {lowest.x, lowest.y, lowest.z, highest.x, highest.y, highest.z};
}

} // namespace

void writeBoxes(std::span<const shader::FieldGroupBlock> groups, std::vector<VkAabbPositionsKHR>& boxes)
{
    boxes.resize(groups.size());
    std::ranges::transform(groups, boxes.begin(), boxAbout);
}

void FieldBoxes::makeRoom(uint32_t count)
{
    if (count <= room_)
        return;
    room_ = std::bit_ceil(count);
    const gpu::AccelSizes sizes = gpu::boxesSizes(*device_, room_);
    accel_ = gpu::Accel(*device_, "field boxes", VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, sizes.structure);
    scratch_ = gpu::Buffer(*device_, "build scratch", sizes.scratch);
}

void FieldBoxes::drop()
{
    accel_ = {};
    scratch_ = {};
    room_ = 0;
}

void FieldBoxes::declare(graph::FrameGraph& graph, const FieldFrame& fields, graph::BufferRef& scene)
{
    writeBoxes(fields.groups, boxes_);
    makeRoom(static_cast<uint32_t>(boxes_.size()));
    graph::Pass pass = graph.add("box builds");
    scene = pass.write(scene, Use::AccelWrite);
    pass.record([this](graph::Recorder& recorder) {
        gpu::recordBuild(recorder.commands(), accel_, {frameCopy(*device_, boxes_), static_cast<uint32_t>(boxes_.size())},
                         scratch_.address());
    });
}

} // namespace antumbra::render
