#include "render/shadow/sdf.h"

namespace antumbra::render {

namespace {

using graph::Use;

uint32_t methodOf(FieldShadow shadow)
{
    switch (shadow) {
    case FieldShadow::Quilez: return shader::kFieldQuilez;
    case FieldShadow::Aaltonen: return shader::kFieldAaltonen;
    case FieldShadow::Cone: return shader::kFieldCone1;
    default: return shader::kFieldSubCones;
    }
}

} // namespace

void FieldShadowSystem::skip(graph::FrameGraph& graph, std::string_view reason) { graph.skip("sdf shadow", reason); }

graph::BufferRef FieldShadowSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const FieldFrame& fields,
                                            const GBuffer& g, VkDeviceAddress area, uint32_t lightCount, const LitPixels& lit,
                                            graph::BufferRef& counters)
{
    const SdfKnobs& knobs = view.knobs.sdf;
    if (!fields || knobs.shadow == FieldShadow::None) {
        skip(graph, fields ? "sdf.shadow is none" : "no SDFPrimitive in the scene");
        return {};
    }
    const uint32_t method = methodOf(knobs.shadow);
    gpu::Pipeline& pipeline = pipelines_[method];
    if (!pipeline) {
        const gpu::ShaderDefine define{"METHOD", static_cast<int>(method)};
        pipeline = computePipeline(*device_, "field_shade.comp", std::span(&define, 1));
    }
    graph::Pass pass = graph.add("sdf shadow");
    pass.read(g.depth, Use::Sampled);
    pass.read(g.normals, Use::Sampled);
    counters = pass.write(counters, Use::StorageWrite);
    const graph::BufferRef seen =
        pass.createBuffer("seen past fields", size_t{lightCount} * lit.extent.x * lit.extent.y * sizeof(float), Use::StorageWrite);
    pass.record([&pipeline, &knobs, frame, fields, g, area, lit, seen, counted = counters](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::FieldShade{.fields = fields.block,
                                             .area = area,
                                             .counters = recorder.address(counted),
                                             .seen = recorder.address(seen),
                                             .frame = frame,
                                             .depth = recorder.sampled(g.depth),
                                             .normals = recorder.sampled(g.normals),
                                             .cones = knobs.cones,
                                             .cells = knobs.cells,
                                             .rays = 0,
                                             .tolerance = knobs.epsilon,
                                             .pixelScale = static_cast<int>(lit.scale),
                                             .litWidth = lit.extent.x,
                                             .litHeight = lit.extent.y},
                          lit.extent, {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
    return seen;
}

} // namespace antumbra::render
