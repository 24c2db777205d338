// The signed distance fields of a frame on their way to the device, and what the camera sees of them. Absent without an SDFPrimitive.
#pragma once

#include "graph/executor.h"
#include "render/field_order.h"
#include "render/field_steps.h"
#include "render/frame_view.h"
#include "render/gpu_scene.h"

#include <deque>
#include <string_view>
#include <vector>

namespace antumbra::render {

/// Where the frame's fields lie.
struct FieldFrame
{
    shader::FieldsBlock block{};     // what is seen
    VkDeviceAddress address = 0;     // of the block on the device
    shader::FieldsBlock shadowing{}; // and, behind it, what stands for characters
    std::string_view structure;      // of `shadowing`: a define of what evaluates it. Empty: it is walked through. Until the next write()

    explicit operator bool() const { return block.groupCount > 0; }
    [[nodiscard]] bool hasBones() const { return shadowing.groupCount > block.groupCount; }
};

class Fields
{
public:
    explicit Fields(gpu::Device& device) : device_(&device) {}

    /// Between Device::beginFrame and endFrame. Keeps its memory.
    FieldFrame write(const FrameView& view);

    /// How fields are drawn into a G-buffer.
    struct Look
    {
        std::string_view firstTerm; // a define of field.frag; empty: the environment's
        std::span<const gpu::Format> colorFormats;
        gpu::Format depthFormat;
        bool keepsMaterial;
        bool keepsSteps;
    };
    /// Makes what draw() takes, where it is not there yet.
    void prepare(const Look& look);
    /// Of the frame that was written and prepared last. Part by part: a ray then meets the steps of what is near it alone.
    void draw(graph::Recorder& recorder, const FrameView& view, uint32_t frame, uvec2 extent) const;

private:
    struct Made
    {
        std::string structure;
        std::string_view firstTerm;
        bool keepsMaterial;
        bool keepsSteps;
        gpu::Pipeline pipeline;
    };

    /// A part of the frame's fields that is drawn alone.
    struct Part
    {
        shader::FieldsBlock block{};
        std::string structure;
        const gpu::Pipeline* pipeline = nullptr;
    };

    void writeDrawnParts(const shader::FieldsBlock& seen);
    const gpu::Pipeline& pipelineFor(const Look& look, std::string_view structure);

    gpu::Device* device_;
    FieldOrder order_;
    std::vector<shader::FieldStepBlock> listed_, steps_; // as the scene lists them, and in order
    std::vector<shader::FieldSurfaceBlock> surfaces_;
    std::vector<shader::FieldGroupBlock> groups_;
    std::vector<FieldPart> partGroups_;
    std::vector<Part> parts_; // the first partGroups_.size() are the frame's
    std::string structure_;
    std::deque<Made> pipelines_;
};

} // namespace antumbra::render
