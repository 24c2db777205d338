#include "render/shadow/sdf.h"

#include <algorithm>

namespace antumbra::render {

namespace {

using graph::Use;
using scene::LightShadow;

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

bool goesByBones(const AreaLightRange& range)
{
    return range.shadow == LightShadow::Analytic || range.shadow == LightShadow::Triangles || range.shadow == LightShadow::None;
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
        if (goesByBones(range))
            lights = {lights ? lights.first : range.first, range.end};
    lights.isAll = lights.end - lights.first == ranges.back().end;
    return lights;
}

bool findsRays(const AreaLightRange& range) { return range.shadow == LightShadow::Traced || range.shadow == LightShadow::Reference; }

} // namespace

void FieldShadowSystem::skip(graph::FrameGraph& graph, std::string_view reason) { graph.skip("sdf shadow", reason); }

const gpu::Pipeline& FieldShadowSystem::pipelineFor(std::string_view structure, uint32_t method, bool hasOutlines, bool hasBones)
{
    const auto found = std::ranges::find_if(pipelines_, [&](const Made& made) {
        return made.structure == structure && made.method == method && made.hasOutlines == hasOutlines && made.hasBones == hasBones;
    });
    if (found != pipelines_.end())
        return found->pipeline;
    std::vector<gpu::ShaderDefine> defines{{"METHOD", static_cast<int>(method)}};
    if (hasOutlines)
        defines.push_back({"OUTLINES"});
    if (hasBones)
        defines.push_back({"BONES"});
    if (!structure.empty())
        defines.push_back({.name = "FIELD_STRUCTURE", .text = structure});
    pipelines_.push_back({std::string(structure), method, hasOutlines, hasBones, computePipeline(*device_, "field_shade.comp", defines)});
    return pipelines_.back().pipeline;
}

graph::BufferRef FieldShadowSystem::declare(graph::FrameGraph& graph, const LitFrame& frame, const FieldFrame& fields,
                                            std::span<const AreaLightRange> ranges, graph::BufferRef& counters)
{
    const Knobs& knobs = frame.view->knobs;
    const BoneLights byBones = boneLightsOf(fields, ranges);
    const bool hasBones = static_cast<bool>(byBones);
    if ((!fields && !hasBones) || knobs.sdf.shadow == FieldShadow::None || std::ranges::all_of(ranges, findsRays)) {
        skip(graph, !fields && !hasBones                    ? "no SDFPrimitive in the scene"
                    : knobs.sdf.shadow == FieldShadow::None ? "sdf.shadow is none"
                                                            : "rays of area.shadow meet distance fields");
        return {};
    }
    const uint32_t method = methodOf(knobs.sdf.shadow);
    const bool hasOutlines = method == shader::kFieldSubCones && !std::ranges::all_of(frame.view->areaLights, &AreaLightDraw::isSphere);
    // Written out, all lights meet the same steps.
    const std::string_view structure = !fields.hasBones() || byBones.isAll ? fields.structure : "";
    graph::Pass pass = graph.add("sdf shadow");
    for (const graph::ImageRef image : {frame.g->depth, frame.g->normals, hasBones ? frame.g->albedo : graph::ImageRef{}})
        if (image)
            pass.read(image, Use::Sampled);
    counters = pass.write(counters, Use::StorageWrite);
    const uint32_t lightCount = ranges.back().end;
    const graph::BufferRef seen =
        pass.createBuffer("seen past fields", lightCount * frame.pixels.count() * sizeof(float), Use::StorageWrite);
    pass.record([&pipeline = pipelineFor(structure, method, hasOutlines, hasBones), &knobs, fields, frame, g = *frame.g, seen,
                 counted = counters, byBones](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::FieldShade{.fields = byBones ? fields.shadowing : fields.block,
                                             .area = frame.area,
                                             .counters = recorder.address(counted),
                                             .seen = recorder.address(seen),
                                             .frame = frame.slot,
                                             .depth = recorder.sampled(g.depth),
                                             .normals = recorder.sampled(g.normals),
                                             .cones = knobs.sdf.cones,
                                             .cells = knobs.sdf.cells,
                                             .rays = raysOf(knobs),
                                             .tolerance = knobs.sdf.epsilon,
                                             .pixelScale = static_cast<int>(frame.pixels.scale),
                                             .litWidth = frame.pixels.extent.x,
                                             .litHeight = frame.pixels.extent.y,
                                             .albedo = byBones ? recorder.sampled(g.albedo) : 0,
                                             .seenGroups = fields.block.groupCount,
                                             .firstByBones = byBones.first,
                                             .endByBones = byBones.end},
                          frame.pixels.extent, {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
    return seen;
}

} // namespace antumbra::render
