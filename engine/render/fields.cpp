#include "render/fields.h"

#include "render/field_steps.h"
#include "render/field_structure.h"
#include "render/frame_copy.h"

#include <algorithm>

namespace antumbra::render {

FieldFrame Fields::write(const FrameView& view)
{
    if (view.fieldSteps.empty())
        return {};
    listed_.clear();
    steps_.clear();
    surfaces_.clear();
    for (const FieldStepDraw& draw : view.fieldSteps)
        listed_.push_back(draw.step);
    for (const uint32_t index : order_.of(listed_)) {
        steps_.push_back(listed_[index]);
        surfaces_.push_back(view.fieldSteps[index].surface);
    }
    writeGroups(steps_, groups_);
    writeStructure(steps_, structure_);
    const shader::FieldsBlock block{.steps = frameCopy(*device_, steps_),
                                    .groups = frameCopy(*device_, groups_),
                                    .surfaces = frameCopy(*device_, surfaces_),
                                    .groupCount = static_cast<uint32_t>(groups_.size()),
                                    .skipped = 0};
    return {.block = block, .address = frameCopy(*device_, std::span(&block, 1)), .structure = structure_};
}

const gpu::Pipeline& Fields::pipelineFor(const Look& look)
{
    const auto found = std::ranges::find_if(pipelines_, [&](const Made& made) {
        return made.structure == structure_ && made.firstTerm == look.firstTerm && made.keepsMaterial == look.keepsMaterial &&
               made.keepsSteps == look.keepsSteps;
    });
    if (found != pipelines_.end())
        return found->pipeline;
    std::vector<gpu::ShaderDefine> defines;
    if (!look.firstTerm.empty())
        defines.push_back({look.firstTerm});
    if (look.keepsMaterial)
        defines.push_back({"KEEPS_MATERIAL"});
    if (look.keepsSteps)
        defines.push_back({"KEEPS_STEPS"});
    if (!structure_.empty())
        defines.push_back({.name = "FIELD_STRUCTURE", .text = structure_});
    pipelines_.push_back({structure_, look.firstTerm, look.keepsMaterial, look.keepsSteps,
                          rasterPipeline(*device_, {.vertexShader = "field.vert",
                                                    .fragmentShader = "field.frag",
                                                    .defines = defines,
                                                    .colorFormats = look.colorFormats,
                                                    .depthFormat = look.depthFormat})});
    return pipelines_.back().pipeline;
}

void Fields::draw(graph::Recorder& recorder, const gpu::Pipeline& pipeline, const FieldFrame& fields, uint32_t frame, uvec2 extent)
{
    const uvec2 tiles = (extent + shader::kFieldTileSize - 1u) / shader::kFieldTileSize;
    recorder.draw(pipeline, shader::FieldDraw{.fields = fields.block, .frame = frame, .extent = ivec2(extent)}, 6 * tiles.x * tiles.y);
}

} // namespace antumbra::render
