#include "render/shadow/sdf.h"

#include "render/shadow/area_pipelines.h"

#include <algorithm>

namespace antumbra::render {

namespace {

using graph::Use;

constexpr uint32_t kReferenceRays = 1024; // where reference.samples does not say

uint32_t methodOf(FieldShadow shadow)
{
    switch (shadow) {
    case FieldShadow::Quilez: return shader::kFieldQuilez;
    case FieldShadow::Aaltonen: return shader::kFieldAaltonen;
    case FieldShadow::Cone: return shader::kFieldCone1;
    case FieldShadow::Traced:
    case FieldShadow::Reference: return shader::kFieldTraced;
    default: return shader::kFieldSubCones;
    }
}

uint32_t raysOf(const Knobs& knobs)
{
    if (knobs.sdf.shadow != FieldShadow::Reference)
        return knobs.area.rays;
    return knobs.reference.samples > 0 ? knobs.reference.samples : kReferenceRays;
}

/// Lights [first, end) that what stands for characters hides: rays to the others meet the meshes.
struct BoneLights
{
    uint32_t first = 0;
    uint32_t end = 0;
    bool isAll = false;

    explicit operator bool() const { return first < end; }
};

BoneLights boneLightsOf(const FieldFrame& fields, std::span<const AreaLightRange> ranges)
{
    BoneLights lights;
    if (!fields.hasBones())
        return lights;
    for (const AreaLightRange& range : ranges) // those that go by bones stand together
        if (!traces(range.shadow) && !isShare(range.shadow))
            lights = {lights ? lights.first : range.first, range.end};
    lights.isAll = lights.end - lights.first == ranges.back().end;
    return lights;
}

const gpu::Pipeline& pipelineFor(const LitFrame& frame, const BoneLights& byBones)
{
    const FieldFrame& fields = *frame.fields;
    const uint32_t method = methodOf(frame.view->knobs.sdf.shadow);
    FieldShader shader{.file = "field_shade.comp"};
    shader.define("METHOD", static_cast<int>(method));
    if (method == shader::kFieldSubCones && !std::ranges::all_of(frame.view->areaLights, &AreaLightDraw::isSphere))
        shader.define("OUTLINES");
    if (!byBones)
        return fields.pipelines->of(shader, fields.structure);
    shader.define("BONES");
    shader.meetsBones = true;
    // Written out, all lights meet the same steps.
    return fields.pipelines->of(shader, byBones.isAll ? fields.shadowingStructure : "");
}

/// But for what the graph places.
shader::FieldShade shadeOf(const LitFrame& frame, const BoneLights& byBones)
{
    const FieldFrame& fields = *frame.fields;
    const Knobs& knobs = frame.view->knobs;
    return {.fields = byBones ? fields.shadowing : fields.block,
            .area = frame.area,
            .frame = frame.slot,
            .cones = knobs.sdf.cones,
            .cells = knobs.sdf.cells,
            .rays = raysOf(knobs),
            .tolerance = knobs.sdf.epsilon,
            .pixelScale = static_cast<int>(frame.pixels.scale),
            .litWidth = frame.pixels.extent.x,
            .litHeight = frame.pixels.extent.y,
            .seenGroups = fields.block.groupCount,
            .firstByBones = byBones.first,
            .endByBones = byBones.end};
}

} // namespace

void skipFieldShadow(graph::FrameGraph& graph, std::string_view reason) { graph.skip("sdf shadow", reason); }

graph::BufferRef declareFieldShadow(graph::FrameGraph& graph, const LitFrame& frame, std::span<const AreaLightRange> ranges,
                                    graph::BufferRef& counters)
{
    const Knobs& knobs = frame.view->knobs;
    const FieldFrame& fields = *frame.fields;
    const BoneLights byBones = boneLightsOf(fields, ranges);
    const bool hasBones = static_cast<bool>(byBones);
    if ((!fields && !hasBones) || knobs.sdf.shadow == FieldShadow::None || std::ranges::all_of(ranges, traces, &AreaLightRange::shadow)) {
        skipFieldShadow(graph, !fields && !hasBones                    ? "no SDFPrimitive in the scene"
                               : knobs.sdf.shadow == FieldShadow::None ? "sdf.shadow is none"
                                                                       : "rays of area.shadow meet distance fields");
        return {};
    }
    graph::Pass pass = graph.add("sdf shadow");
    for (const graph::ImageRef image : {frame.g->depth, frame.g->normals, hasBones ? frame.g->albedo : graph::ImageRef{}})
        if (image)
            pass.read(image, Use::Sampled);
    counters = pass.write(counters, Use::StorageWrite);
    const uint32_t lightCount = ranges.back().end;
    const graph::BufferRef seen =
        pass.createBuffer("seen past fields", lightCount * frame.pixels.count() * sizeof(float), Use::StorageWrite);
    pass.record([&pipeline = pipelineFor(frame, byBones), shade = shadeOf(frame, byBones), extent = frame.pixels.extent, g = *frame.g, seen,
                 counted = counters, hasBones](graph::Recorder& recorder) {
        shader::FieldShade made = shade;
        made.counters = recorder.address(counted);
        made.seen = recorder.address(seen);
        made.depth = recorder.sampled(g.depth);
        made.normals = recorder.sampled(g.normals);
        made.albedo = hasBones ? recorder.sampled(g.albedo) : 0;
        recorder.dispatch(pipeline, made, extent, {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
    return seen;
}

} // namespace antumbra::render
