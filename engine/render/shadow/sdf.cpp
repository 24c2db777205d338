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

bool findsRays(const AreaLightRange& range) { return range.shadow == LightShadow::Traced || range.shadow == LightShadow::Reference; }

} // namespace

void FieldShadowSystem::skip(graph::FrameGraph& graph, std::string_view reason) { graph.skip("sdf shadow", reason); }

const gpu::Pipeline& FieldShadowSystem::pipelineFor(std::string_view structure, uint32_t method, bool hasOutlines)
{
    const auto found = std::ranges::find_if(pipelines_, [&](const Made& made) {
        return made.structure == structure && made.method == method && made.hasOutlines == hasOutlines;
    });
    if (found != pipelines_.end())
        return found->pipeline;
    std::vector<gpu::ShaderDefine> defines{{"METHOD", static_cast<int>(method)}};
    if (hasOutlines)
        defines.push_back({"OUTLINES"});
    if (!structure.empty())
        defines.push_back({.name = "FIELD_STRUCTURE", .text = structure});
    pipelines_.push_back({std::string(structure), method, hasOutlines, computePipeline(*device_, "field_shade.comp", defines)});
    return pipelines_.back().pipeline;
}

graph::BufferRef FieldShadowSystem::declare(graph::FrameGraph& graph, const LitFrame& frame, const FieldFrame& fields,
                                            std::span<const AreaLightRange> ranges, graph::BufferRef& counters)
{
    const Knobs& knobs = frame.view->knobs;
    if (!fields || knobs.sdf.shadow == FieldShadow::None || std::ranges::all_of(ranges, findsRays)) {
        skip(graph, !fields                                 ? "no SDFPrimitive in the scene"
                    : knobs.sdf.shadow == FieldShadow::None ? "sdf.shadow is none"
                                                            : "rays of area.shadow meet distance fields");
        return {};
    }
    const uint32_t method = methodOf(knobs.sdf.shadow);
    const bool hasOutlines = method == shader::kFieldSubCones && !std::ranges::all_of(frame.view->areaLights, &AreaLightDraw::isSphere);
    graph::Pass pass = graph.add("sdf shadow");
    pass.read(frame.g->depth, Use::Sampled);
    pass.read(frame.g->normals, Use::Sampled);
    counters = pass.write(counters, Use::StorageWrite);
    const uint32_t lightCount = ranges.back().end;
    const graph::BufferRef seen =
        pass.createBuffer("seen past fields", lightCount * frame.pixels.count() * sizeof(float), Use::StorageWrite);
    pass.record([&pipeline = pipelineFor(fields.structure, method, hasOutlines), &knobs, fields, frame, g = *frame.g, seen,
                 counted = counters](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::FieldShade{.fields = fields.block,
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
                                             .litHeight = frame.pixels.extent.y},
                          frame.pixels.extent, {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
    return seen;
}

} // namespace antumbra::render
