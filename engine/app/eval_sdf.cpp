#include "app/eval.h"
#include "app/eval_cases.h"
#include "base/error.h"
#include "gpu/dispatch.h"
#include "render/field_steps.h"
#include "scene/scene_parts.h"

#include <algorithm>
#include <cmath>

namespace antumbra::app {

namespace {

using nlohmann::json;
using render::FieldShadow;

/// A primitive of golden/README.md, which says "type" and "op" where a scene file says "shape" and "operation".
scene::SDFPrimitive primitiveOf(const scene::JsonObject& from, const json& value, const Path& file)
{
    json renamed = value;
    for (const auto& [theirs, ours] : {std::pair("type", "shape"), std::pair("op", "operation")}) {
        if (!value.contains(theirs))
            from.refuse(theirs, "is missing");
        renamed[ours] = value[theirs];
        renamed.erase(theirs);
    }
    std::vector<std::string> fields;
    const scene::SDFPrimitive primitive = scene::readSDFPrimitive(scene::JsonObject(renamed, file, "scene"), fields);
    if (primitive.shape == scene::SDFShape::Bones)
        from.refuse("type", "is of a character, and there is none");
    return primitive;
}

/// What the device reads beside the cases.
struct FieldBlocks
{
    std::vector<shader::FieldStepBlock> steps;
    std::vector<shader::FieldGroupBlock> groups;
};

/// Its groups are an offset until they are on the device.
shader::FieldCase deviceCase(const EvalCase& each, FieldBlocks& blocks)
{
    const EvalSphere light = sphereOf(each.object.object("light"));
    shader::FieldCase made{.position = each.vector("p"),
                           .centre = light.centre,
                           .radius = light.radius,
                           .fields = {.groups = blocks.groups.size() * sizeof(shader::FieldGroupBlock)}};
    std::vector<shader::FieldStepBlock> steps;
    std::vector<shader::FieldGroupBlock> groups;
    const std::vector<scene::JsonObject> primitives = each.object.objects("scene");
    for (size_t i = 0; i < primitives.size(); ++i) {
        auto step = render::fieldStep(primitiveOf(primitives[i], each.value["scene"][i], each.file), mat4{1});
        if (!step)
            primitives[i].refuse("", "has no shape: a parameter is not finite");
        step->flags = i == 0 ? shader::kFieldBegins : 0u;
        steps.push_back(*step);
    }
    render::writeGroups(steps, groups);
    made.fields.groupCount = static_cast<uint32_t>(groups.size());
    made.fields.takesAway = render::takesAway(groups);
    for (shader::FieldGroupBlock& group : groups) {
        group.firstStep += static_cast<uint32_t>(blocks.steps.size());
        group.endStep += static_cast<uint32_t>(blocks.steps.size());
    }
    blocks.steps.insert(blocks.steps.end(), steps.begin(), steps.end());
    blocks.groups.insert(blocks.groups.end(), groups.begin(), groups.end());
    return made;
}

uint32_t methodOf(FieldShadow shadow)
{
    switch (shadow) {
    case FieldShadow::Quilez: return shader::kFieldQuilez;
    case FieldShadow::Aaltonen: return shader::kFieldAaltonen;
    case FieldShadow::Cone: return shader::kFieldCone1;
    case FieldShadow::SubCones: return shader::kFieldSubCones;
    default: throw Error("of quilez, aaltonen, cone, sub-cones", "sdf.shadow");
    }
}

bool isSettled(const EvalCase& each)
{
    constexpr std::string_view kSettled[] = {"empty", "inside_light", "inside_solid", "full_umbra"};
    return std::ranges::find(kSettled, each.object.text("class", "")) != std::end(kSettled);
}

} // namespace

Evaluation evaluateSdf(gpu::Device& device, const Path& file, const render::SdfKnobs& knobs)
{
    const EvalCases cases(file);
    const gpu::Pipeline pipeline = gpu::computePipeline(device, "eval_sdf.comp");
    Evaluation evaluation{.cases = cases.size()};
    json results = json::array();
    for (size_t first = 0; first < cases.size(); first += EvalCases::kBatch) {
        const std::span<const EvalCase> batch = cases.batch(first);
        FieldBlocks blocks;
        std::vector<shader::FieldCase> deviceCases;
        for (const EvalCase& each : batch)
            deviceCases.push_back(deviceCase(each, blocks));
        const gpu::Buffer steps = gpu::uploadedBuffer(device, "field steps", std::span<const shader::FieldStepBlock>(blocks.steps));
        const gpu::Buffer groups = gpu::uploadedBuffer(device, "field groups", std::span<const shader::FieldGroupBlock>(blocks.groups));
        for (shader::FieldCase& each : deviceCases) {
            each.fields.steps = steps.address();
            each.fields.groups += groups.address();
        }
        const gpu::Buffer inputs = gpu::uploadedBuffer(device, "field cases", std::span<const shader::FieldCase>(deviceCases));
        const gpu::Buffer answers(device, "field answers", batch.size() * sizeof(shader::FieldAnswer), gpu::MemoryKind::Readback);
        const auto count = static_cast<uint32_t>(batch.size());
        dispatchNow(device, pipeline,
                    shader::EvalField{.cases = inputs.address(),
                                      .answers = answers.address(),
                                      .caseCount = count,
                                      .method = methodOf(knobs.shadow),
                                      .cones = knobs.cones,
                                      .tolerance = knobs.epsilon},
                    count);
        const std::span<const shader::FieldAnswer> found = gpu::mappedValues<const shader::FieldAnswer>(answers, count);
        for (size_t i = 0; i < batch.size(); ++i) {
            results.push_back({{"id", batch[i].id}, {"visibility", found[i].visibility}, {"evaluations", found[i].evaluations}});
            if (!batch[i].object.has("visibility"))
                continue;
            const double answer = batch[i].object.number("visibility", 0, {0, 1});
            evaluation.comparison.add(batch[i].id, std::abs(found[i].visibility - answer), isSettled(batch[i]) ? 0.01 : 0.12);
        }
    }
    evaluation.results = results.dump(1) + '\n';
    return evaluation;
}

} // namespace antumbra::app
