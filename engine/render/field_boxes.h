// Boxes about the groups of a frame's distance fields, as procedural geometry of the acceleration structure: by them rays find which groups
// they meet (lib/field_boxes.glsl). Absent where no ray is traced or none by ray queries.
#pragma once

#include "gpu/accel.h"
#include "graph/executor.h"
#include "render/fields.h"

#include <span>
#include <vector>

namespace antumbra::render {

/// Metres, in the world: each about a group and what it melts with, a little larger than shaders have it. Keeps the memory of
/// `boxes`.
void writeBoxes(std::span<const shader::FieldGroupBlock> groups, std::vector<VkAabbPositionsKHR>& boxes);

class FieldBoxes
{
public:
    explicit FieldBoxes(gpu::Device& device) : device_(&device) {}

    /// Builds them anew, as groups may move: before the scene, which `scene` stands for. Grows with the most groups so far.
    void declare(graph::FrameGraph& graph, const FieldFrame& fields, graph::BufferRef& scene);
    /// Lets the memory go.
    void drop();

    /// The box with the number g is that of the g-th group.
    [[nodiscard]] const gpu::Accel& accel() const { return accel_; }

private:
    void makeRoom(uint32_t count);

    gpu::Device* device_;
    gpu::Accel accel_;
    gpu::Buffer scratch_;
    std::vector<VkAabbPositionsKHR> boxes_;
    uint32_t room_ = 0; // for boxes
};

} // namespace antumbra::render
