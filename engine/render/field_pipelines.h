// Pipelines that are made for the structure of distance fields, cached by it. Those of a new structure can be made on a thread of their own
// while frames go on with what is there.
#pragma once

#include "gpu/pipeline.h"

#include <algorithm>
#include <array>
#include <future>
#include <list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace antumbra::render {

/// What a structure is compiled into. Texts last as long as the program.
struct FieldShader
{
    std::string_view file;                            // .comp, or .frag, drawn by field.vert
    std::array<gpu::ShaderDefine, 6> defines{};       // beside FIELD_STRUCTURE; the first without a name ends them
    std::array<gpu::Format, 5> colorFormats{};        // of .frag; the first undefined one ends them
    gpu::Format depthFormat = gpu::Format::Undefined; // of .frag
    bool meetsBones = false;                          // the steps that stand for characters too

    void define(std::string_view name, int value = 1) { *std::ranges::find(defines, gpu::ShaderDefine{}) = {name, value}; }
    [[nodiscard]] std::span<const gpu::ShaderDefine> defined() const
    {
        return {defines.begin(), std::ranges::find(defines, gpu::ShaderDefine{})};
    }
    void addColor(gpu::Format format) { *std::ranges::find(colorFormats, gpu::Format::Undefined) = format; }
    [[nodiscard]] bool isDrawn() const { return file.ends_with(".frag"); }

    friend bool operator==(const FieldShader&, const FieldShader&) = default;
};

/// The structure is as render/field_structure.h writes it; empty: its steps are walked through.
struct FieldPipelineKey
{
    FieldShader shader;
    std::string structure;
};

class FieldPipelines
{
public:
    /// Beyond this many, those that no frame has asked for for longest are let go.
    static constexpr size_t kMostKept = 64;

    explicit FieldPipelines(gpu::Device& device) : device_(&device) {}

    void beginFrame();
    /// Made at once where it is not there; stays for this frame. Throws Error where it does not compile.
    const gpu::Pipeline& of(const FieldShader& shader, std::string_view structure);
    /// What the frame before asked for, each once.
    [[nodiscard]] const std::vector<FieldShader>& askedBefore() const { return askedBefore_; }
    /// Whether all are there; where not, the rest is on its way. Throws Error for one that did not compile.
    bool areThere(const std::vector<FieldPipelineKey>& keys);

private:
    struct Made
    {
        FieldPipelineKey key;
        gpu::Pipeline pipeline;
        uint64_t frame = 0; // that asked for it last
    };

    Made* find(const FieldShader& shader, std::string_view structure);
    Made& keep(Made made);

    gpu::Device* device_;
    uint64_t frame_ = 0;
    std::list<Made> made_; // last asked for first
    std::vector<FieldShader> asked_, askedBefore_;
    std::future<std::vector<Made>> making_;
};

} // namespace antumbra::render
