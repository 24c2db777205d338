#include "render/field_pipelines.h"

#include <algorithm>
#include <chrono>

namespace antumbra::render {

namespace {

gpu::Pipeline makePipeline(gpu::Device& device, const FieldPipelineKey& key)
{
    const FieldShader& shader = key.shader;
    std::vector<gpu::ShaderDefine> defines(shader.defined().begin(), shader.defined().end());
    if (!key.structure.empty())
        defines.push_back({.name = "FIELD_STRUCTURE", .text = key.structure});
    if (!key.structure.empty() && device.info().isCpu) // what a CPU device reads in a loop it gathers each time; a GPU's registers are few
        defines.push_back({.name = "HOLDS_STEPS"});
    if (!shader.isDrawn())
        return computePipeline(device, shader.file, defines);
    const auto end = std::ranges::find(shader.colorFormats, gpu::Format::Undefined);
    return rasterPipeline(device, {.vertexShader = "field.vert",
                                   .fragmentShader = shader.file,
                                   .defines = defines,
                                   .colorFormats = std::span(shader.colorFormats.begin(), end),
                                   .depthFormat = shader.depthFormat});
}

} // namespace

void FieldPipelines::beginFrame()
{
    ++frame_;
    std::swap(asked_, askedBefore_);
    asked_.clear();
}

FieldPipelines::Made* FieldPipelines::find(const FieldShader& shader, std::string_view structure)
{
    const auto found =
        std::ranges::find_if(made_, [&](const Made& made) { return made.key.structure == structure && made.key.shader == shader; });
    if (found == made_.end())
        return nullptr;
    made_.splice(made_.begin(), made_, found);
    found->frame = frame_;
    return &*found;
}

FieldPipelines::Made& FieldPipelines::keep(Made made)
{
    made.frame = frame_;
    made_.push_front(std::move(made));
    while (made_.size() > kMostKept && made_.back().frame < frame_)
        made_.pop_back(); // the device keeps it for frames in flight
    return made_.front();
}

const gpu::Pipeline& FieldPipelines::of(const FieldShader& shader, std::string_view structure)
{
    if (std::ranges::find(asked_, shader) == asked_.end())
        asked_.push_back(shader);
    if (const Made* made = find(shader, structure))
        return made->pipeline;
    FieldPipelineKey key{shader, std::string(structure)};
    gpu::Pipeline pipeline = makePipeline(*device_, key);
    return keep({std::move(key), std::move(pipeline)}).pipeline;
}

bool FieldPipelines::areThere(const std::vector<FieldPipelineKey>& keys)
{
    if (making_.valid()) {
        if (making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return false;
        for (Made& made : making_.get())
            keep(std::move(made));
    }
    std::vector<FieldPipelineKey> missing;
    for (const FieldPipelineKey& key : keys)
        if (find(key.shader, key.structure) == nullptr)
            missing.push_back(key);
    if (missing.empty())
        return true;
    making_ = std::async(std::launch::async, [device = device_, missing = std::move(missing)] {
        std::vector<Made> made;
        for (const FieldPipelineKey& key : missing)
            made.push_back({key, makePipeline(*device, key)});
        return made;
    });
    return false;
}

} // namespace antumbra::render
