#include "render/fields.h"

#include "render/field_structure.h"
#include "render/frame_blocks.h"
#include "render/frame_copy.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace antumbra::render {

namespace {

struct Tiles
{
    uvec2 first;
    uvec2 count;
};

/// That may show what the groups hold: those about their boxes and what they melt with, or all where a box reaches behind the eye.
Tiles tilesOf(std::span<const shader::FieldGroupBlock> groups, const mat4& clipFromWorld, uvec2 extent)
{
    constexpr float kTileSize = shader::kFieldTileSize;
    const uvec2 all = (extent + shader::kFieldTileSize - 1u) / shader::kFieldTileSize;
    vec2 lowest{1}, highest{-1}; // in clip space, within the picture
    for (const shader::FieldGroupBlock& group : groups) {
        const vec3 half = group.halfEdges + group.melt / group.slope;
        for (int corner = 0; corner < 8; ++corner) {
            const vec3 towards = 2.0f * vec3(corner & 1, corner >> 1 & 1, corner >> 2) - 1.0f;
            const vec4 clip = clipFromWorld * vec4(group.centre + half * towards, 1);
            if (!(clip.w > 1e-3f * glm::length(half))) // so that rounding does not matter
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
    pipelines_.beginFrame();
    order(view);
    const bool isLate = !mayShowNext(view);
    if (!isLate)
        std::swap(shown_, next_);
    FieldFrame frame = copyShown();
    frame.isLate = isLate;
    return frame;
}

void Fields::order(const FrameView& view)
{
    listed_.clear();
    for (const FieldStepDraw& draw : view.fieldSteps)
        listed_.push_back(draw.step);
    listed_.insert(listed_.end(), view.boneSteps.begin(), view.boneSteps.end());
    next_.steps.clear();
    next_.surfaces.clear();
    for (const uint32_t index : order_.of(listed_)) { // where a field ends, those before it stay before it
        next_.steps.push_back(listed_[index]);
        if (index < view.fieldSteps.size())
            next_.surfaces.push_back(view.fieldSteps[index].surface);
    }
    writeGroups(next_.steps, next_.groups);
    next_.seenGroups = static_cast<uint32_t>(
        std::ranges::lower_bound(next_.groups, next_.surfaces.size(), {}, &shader::FieldGroupBlock::firstStep) - next_.groups.begin());
    writeStructures(next_);
    divide(next_);
}

void Fields::writeStructures(Ordered& ordered)
{
    writeStructure(ordered.steps, std::span(ordered.groups).first(ordered.seenGroups), ordered.structure);
    writeStructure(ordered.steps, ordered.groups, ordered.shadowingStructure);
}

void Fields::divide(Ordered& ordered)
{
    writeParts(ordered.steps, std::span(ordered.groups).first(ordered.seenGroups), partGroups_);
    ordered.partCount = partGroups_.size();
    ordered.parts.resize(std::max(ordered.parts.size(), ordered.partCount));
    for (size_t i = 0; i < ordered.partCount; ++i) {
        Part& part = ordered.parts[i];
        part.groups = partGroups_[i];
        const auto [first, end] = part.groups;
        writeStructure(ordered.steps, std::span(ordered.groups).subspan(first, end - first), part.structure);
    }
}

bool Fields::isAsShown() const
{
    return next_.structure == shown_.structure && next_.shadowingStructure == shown_.shadowingStructure &&
           std::ranges::equal(next_.drawn(), shown_.drawn(), {}, &Part::structure, &Part::structure);
}

/// A field whose structure is new stays as it was until all is there that the frame before asked for.
bool Fields::mayShowNext(const FrameView& view)
{
    if (view.waitsForPipelines || next_.steps.empty() || isAsShown())
        return true;
    std::vector<FieldPipelineKey> keys;
    for (const FieldShader& shader : pipelines_.askedBefore())
        if (shader.isDrawn())
            std::ranges::transform(next_.drawn(), std::back_inserter(keys), [&](const Part& part) {
                return FieldPipelineKey{shader, part.structure};
            });
        else
            keys.push_back({shader, shader.meetsBones ? next_.shadowingStructure : next_.structure});
    return pipelines_.areThere(keys);
}

FieldFrame Fields::copyShown()
{
    if (shown_.steps.empty())
        return {};
    const shader::FieldsBlock all{.steps = frameCopy(*device_, shown_.steps),
                                  .groups = frameCopy(*device_, shown_.groups),
                                  .surfaces = frameCopy(*device_, shown_.surfaces),
                                  .skipped = uvec2(0),
                                  .groupCount = static_cast<uint32_t>(shown_.groups.size()),
                                  .takesAway = takesAway(shown_.groups)};
    shader::FieldsBlock seen = all;
    seen.groupCount = shown_.seenGroups;
    for (Part& part : shown_.drawn()) {
        const auto [firstGroup, endGroup] = part.groups;
        part.block = seen;
        part.block.groups += firstGroup * sizeof(shader::FieldGroupBlock);
        part.block.groupCount = endGroup - firstGroup;
        if (part.structure.empty()) // groups count steps from the first of all, what is written out from its own first
            continue;
        const uint32_t firstStep = shown_.groups[firstGroup].firstStep;
        part.block.steps += firstStep * sizeof(shader::FieldStepBlock);
        part.block.surfaces += firstStep * sizeof(shader::FieldSurfaceBlock);
    }
    return {.block = seen,
            .address = frameCopy(*device_, std::span<const shader::FieldsBlock>(&seen, 1)),
            .groups = std::span(shown_.groups).first(shown_.seenGroups),
            .shadowing = all,
            .structure = shown_.structure,
            .shadowingStructure = shown_.shadowingStructure,
            .pipelines = &pipelines_};
}

void Fields::prepare(const FieldShader& shader)
{
    for (Part& part : shown_.drawn())
        part.pipeline = &pipelines_.of(shader, part.structure);
}

void Fields::draw(graph::Recorder& recorder, const FrameView& view, uint32_t frame, uvec2 extent) const
{
    const mat4 clip = clipFromWorld(view.camera, extent);
    for (const Part& part : shown_.drawn()) {
        const auto [firstGroup, endGroup] = part.groups;
        const Tiles tiles = tilesOf(std::span(shown_.groups).subspan(firstGroup, endGroup - firstGroup), clip, extent);
        if (tiles.count.x == 0 || tiles.count.y == 0)
            continue;
        recorder.draw(
            *part.pipeline,
            shader::FieldDraw{
                .fields = part.block, .frame = frame, .extent = ivec2(extent), .firstTile = tiles.first, .tilesAcross = tiles.count.x},
            6 * tiles.count.x * tiles.count.y);
    }
}

} // namespace antumbra::render
