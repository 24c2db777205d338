#include "render/fields.h"

#include "render/field_steps.h"
#include "render/frame_copy.h"

#include <algorithm>

namespace antumbra::render {

namespace {

constexpr float kFarthestSeen = 1e4f; // metres from the eye, of what has no end

/// A box about what the step adds; an empty one where it only takes away.
void addBox(FieldFrame& fields, const shader::FieldStepBlock& step, vec3 eye)
{
    if (step.operation == shader::kFieldSubtract || step.operation == shader::kFieldIntersect)
        return;
    const FieldBound bound = boundOf(step);
    const bool isBounded = bound.radius < kFieldUnbounded;
    const vec3 centre = isBounded ? bound.centre : eye;
    const vec3 reach(isBounded ? bound.radius + step.blend : kFarthestSeen);
    fields.lowest = glm::min(fields.lowest, centre - reach);
    fields.highest = glm::max(fields.highest, centre + reach);
}

} // namespace

FieldFrame Fields::write(const FrameView& view)
{
    if (view.fieldSteps.empty())
        return {};
    listed_.clear();
    steps_.clear();
    surfaces_.clear();
    FieldFrame fields{.lowest = vec3(1e30f), .highest = vec3(-1e30f)};
    for (const FieldStepDraw& draw : view.fieldSteps) {
        listed_.push_back(draw.step);
        addBox(fields, draw.step, view.camera.eye);
    }
    for (const uint32_t index : order_.of(listed_)) {
        steps_.push_back(listed_[index]);
        surfaces_.push_back(view.fieldSteps[index].surface);
    }
    writeGroups(steps_, groups_);
    fields.block = {.steps = frameCopy(*device_, steps_),
                    .groups = frameCopy(*device_, groups_),
                    .surfaces = frameCopy(*device_, surfaces_),
                    .groupCount = static_cast<uint32_t>(groups_.size()),
                    .skipped = 0};
    return fields;
}

const gpu::Pipeline& Fields::pipelineFor(const Look& look)
{
    const auto found = std::ranges::find_if(pipelines_, [&](const Made& made) {
        return made.firstTerm == look.firstTerm && made.keepsMaterial == look.keepsMaterial && made.keepsSteps == look.keepsSteps;
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
    pipelines_.push_back({look.firstTerm, look.keepsMaterial, look.keepsSteps,
                          rasterPipeline(*device_, {.vertexShader = "sky.vert",
                                                    .fragmentShader = "field.frag",
                                                    .defines = defines,
                                                    .colorFormats = look.colorFormats,
                                                    .depthFormat = look.depthFormat})});
    return pipelines_.back().pipeline;
}

void Fields::draw(graph::Recorder& recorder, const gpu::Pipeline& pipeline, const FieldFrame& fields, uint32_t frame)
{
    recorder.draw(pipeline, shader::FieldDraw{.fields = fields.block, .lowest = fields.lowest, .highest = fields.highest, .frame = frame},
                  3);
}

} // namespace antumbra::render
