#include "render/fields.h"

#include "render/field_structure.h"
#include "render/frame_blocks.h"
#include "render/frame_copy.h"

#include <algorithm>

namespace antumbra::render {

namespace {

struct Tiles
{
    uvec2 first;
    uvec2 count;
};

/// That may show what the groups hold: those about the boxes around their spheres, or all where a box reaches behind the eye.
Tiles tilesOf(std::span<const shader::FieldGroupBlock> groups, const mat4& clipFromWorld, uvec2 extent)
{
    constexpr float kTileSize = shader::kFieldTileSize;
    const uvec2 all = (extent + shader::kFieldTileSize - 1u) / shader::kFieldTileSize;
    vec2 lowest{1}, highest{-1}; // in clip space, within the picture
    for (const shader::FieldGroupBlock& group : groups) {
        const float radius = group.reach / std::max(group.slope, 1e-6f);
        for (int corner = 0; corner < 8; ++corner) {
            const vec3 towards = 2.0f * vec3(corner & 1, corner >> 1 & 1, corner >> 2) - 1.0f;
            const vec4 clip = clipFromWorld * vec4(group.centre + radius * towards, 1);
            if (!(clip.w > 1e-3f * radius)) // so that rounding does not matter
                return {uvec2(0), all};
            lowest = glm::min(lowest, vec2(clip) / clip.w);
            highest = glm::max(highest, vec2(clip) / clip.w);
        }
    }
    const auto tileAt = [&](vec2 clip) { return glm::clamp((0.5f * clip + 0.5f) * vec2(extent) / kTileSize, vec2(0), vec2(all)); };
    const uvec2 first(glm::floor(tileAt(lowest))), end(glm::ceil(tileAt(highest)));
    return {first, glm::max(end, first) - first};
}

} // namespace

FieldFrame Fields::write(const FrameView& view)
{
    partGroups_.clear();
    if (view.fieldSteps.empty() && view.boneSteps.empty())
        return {};
    listed_.clear();
    steps_.clear();
    surfaces_.clear();
    for (const FieldStepDraw& draw : view.fieldSteps)
        listed_.push_back(draw.step);
    listed_.insert(listed_.end(), view.boneSteps.begin(), view.boneSteps.end());
    for (const uint32_t index : order_.of(listed_)) { // where a field ends, those before it stay before it
        steps_.push_back(listed_[index]);
        if (index < view.fieldSteps.size())
            surfaces_.push_back(view.fieldSteps[index].surface);
    }
    writeGroups(steps_, groups_);
    writeStructure(steps_, structure_);
    const shader::FieldsBlock all{.steps = frameCopy(*device_, steps_),
                                  .groups = frameCopy(*device_, groups_),
                                  .surfaces = frameCopy(*device_, surfaces_),
                                  .groupCount = static_cast<uint32_t>(groups_.size()),
                                  .skipped = 0};
    shader::FieldsBlock seen = all;
    seen.groupCount = static_cast<uint32_t>(std::ranges::lower_bound(groups_, surfaces_.size(), {}, &shader::FieldGroupBlock::firstStep) -
                                            groups_.begin());
    writeDrawnParts(seen);
    return {.block = seen,
            .address = frameCopy(*device_, std::span<const shader::FieldsBlock>(&seen, 1)),
            .shadowing = all,
            .structure = structure_};
}

void Fields::writeDrawnParts(const shader::FieldsBlock& seen)
{
    writeParts(steps_, std::span(groups_).first(seen.groupCount), partGroups_);
    parts_.resize(std::max(parts_.size(), partGroups_.size()));
    for (size_t i = 0; i < partGroups_.size(); ++i) {
        const auto [firstGroup, endGroup] = partGroups_[i];
        const uint32_t firstStep = groups_[firstGroup].firstStep, endStep = groups_[endGroup - 1].endStep;
        Part& part = parts_[i];
        writeStructure(std::span(steps_).subspan(firstStep, endStep - firstStep), part.structure);
        part.block = {.steps = seen.steps,
                      .groups = seen.groups + firstGroup * sizeof(shader::FieldGroupBlock),
                      .surfaces = seen.surfaces,
                      .groupCount = endGroup - firstGroup,
                      .skipped = 0};
        if (part.structure.empty()) // groups count steps from the first of all, what is written out from its own first
            continue;
        part.block.steps += firstStep * sizeof(shader::FieldStepBlock);
        part.block.surfaces += firstStep * sizeof(shader::FieldSurfaceBlock);
    }
}

void Fields::prepare(const Look& look)
{
    for (size_t i = 0; i < partGroups_.size(); ++i)
        parts_[i].pipeline = &pipelineFor(look, parts_[i].structure);
}

const gpu::Pipeline& Fields::pipelineFor(const Look& look, std::string_view structure)
{
    const auto found = std::ranges::find_if(pipelines_, [&](const Made& made) {
        return made.structure == structure && made.firstTerm == look.firstTerm && made.keepsMaterial == look.keepsMaterial &&
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
    if (!structure.empty())
        defines.push_back({.name = "FIELD_STRUCTURE", .text = structure});
    pipelines_.push_back({std::string(structure), look.firstTerm, look.keepsMaterial, look.keepsSteps,
                          rasterPipeline(*device_, {.vertexShader = "field.vert",
                                                    .fragmentShader = "field.frag",
                                                    .defines = defines,
                                                    .colorFormats = look.colorFormats,
                                                    .depthFormat = look.depthFormat})});
    return pipelines_.back().pipeline;
}

void Fields::draw(graph::Recorder& recorder, const FrameView& view, uint32_t frame, uvec2 extent) const
{
    const mat4 clip = clipFromWorld(view.camera, extent);
    for (size_t i = 0; i < partGroups_.size(); ++i) {
        const auto [firstGroup, endGroup] = partGroups_[i];
        const Tiles tiles = tilesOf(std::span(groups_).subspan(firstGroup, endGroup - firstGroup), clip, extent);
        if (tiles.count.x == 0 || tiles.count.y == 0)
            continue;
        recorder.draw(
            *parts_[i].pipeline,
            shader::FieldDraw{
                .fields = parts_[i].block, .frame = frame, .extent = ivec2(extent), .firstTile = tiles.first, .tilesAcross = tiles.count.x},
            6 * tiles.count.x * tiles.count.y);
    }
}

} // namespace antumbra::render
