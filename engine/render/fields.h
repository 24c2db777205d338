// The signed distance fields of a frame on their way to the device, and what the camera sees of them. Absent without an SDFPrimitive.
#pragma once

#include "graph/executor.h"
#include "render/field_order.h"
#include "render/field_pipelines.h"
#include "render/field_steps.h"
#include "render/frame_view.h"
#include "render/gpu_scene.h"

#include <span>
#include <string_view>
#include <vector>

namespace antumbra::render {

/// Where the frame's fields lie.
struct FieldFrame
{
    shader::FieldsBlock block{};                     // what is seen
    VkDeviceAddress address = 0;                     // of the block on the device
    std::span<const shader::FieldGroupBlock> groups; // that are seen. Until the next write()
    shader::FieldsBlock shadowing{};                 // and, behind it, what stands for characters
    std::string_view structure;          // of `block`: a define of what evaluates it. Empty: it is walked through. Until the next write()
    std::string_view shadowingStructure; // the same of `shadowing`
    FieldPipelines* pipelines = nullptr; // of what is made for it
    bool isLate = false;                 // not the view's: those of a frame before, as the pipelines for them are not there yet

    explicit operator bool() const { return block.groupCount > 0; }
    [[nodiscard]] bool hasBones() const { return shadowing.groupCount > block.groupCount; }
};

class Fields
{
public:
    explicit Fields(gpu::Device& device) : device_(&device), pipelines_(device) {}

    /// Between Device::beginFrame and endFrame. Keeps its memory.
    FieldFrame write(const FrameView& view);

    /// Makes what draw() takes, where it is not there yet: `shader` is of field.frag.
    void prepare(const FieldShader& shader);
    /// Of the frame that was written and prepared last. Part by part: a ray then meets the steps of what is near it alone.
    void draw(graph::Recorder& recorder, const FrameView& view, uint32_t frame, uvec2 extent) const;

private:
    /// A part of the fields that is drawn alone.
    struct Part
    {
        FieldPart groups{};
        std::string structure;
        shader::FieldsBlock block{};
        const gpu::Pipeline* pipeline = nullptr;
    };

    /// Fields in order, and how they are evaluated.
    struct Ordered
    {
        std::vector<shader::FieldStepBlock> steps;
        std::vector<shader::FieldSurfaceBlock> surfaces; // of the first steps: what is seen
        std::vector<shader::FieldGroupBlock> groups;
        uint32_t seenGroups = 0;
        std::string structure;          // of what is seen,
        std::string shadowingStructure; // and of all
        std::vector<Part> parts;
        size_t partCount = 0; // of `parts`: the rest is kept for its memory

        [[nodiscard]] std::span<const Part> drawn() const { return std::span(parts).first(partCount); }
        [[nodiscard]] std::span<Part> drawn() { return std::span(parts).first(partCount); }
    };

    void order(const FrameView& view);
    static void writeStructures(Ordered& ordered);
    void divide(Ordered& ordered);
    [[nodiscard]] bool isAsShown() const;
    [[nodiscard]] bool mayShowNext(const FrameView& view);
    [[nodiscard]] FieldFrame copyShown();

    gpu::Device* device_;
    FieldPipelines pipelines_;
    FieldOrder order_;
    std::vector<shader::FieldStepBlock> listed_; // as the scene lists them
    std::vector<FieldPart> partGroups_;
    Ordered next_, shown_; // of the view, and of the frame
};

} // namespace antumbra::render
