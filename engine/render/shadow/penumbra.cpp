#include "render/shadow/penumbra.h"

namespace antumbra::render {

namespace {

using graph::Use;

constexpr uvec2 kGroup{shader::kAreaGroupWidth, shader::kAreaGroupHeight};

} // namespace

void PenumbraSystem::skip(graph::FrameGraph& graph, std::string_view reason)
{
    graph.skip("area shadow rays", reason);
    graph.skip("area penumbra", reason);
}

graph::BufferRef PenumbraSystem::declareTrace(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range)
{
    const bool isBvh = frame.scene->backend() == RayBackend::ComputeBvh;
    gpu::Pipeline& pipeline = trace_[isBvh ? 1 : 0];
    constexpr gpu::ShaderDefine bvh{"COMPUTE_BVH"};
    if (!pipeline)
        pipeline = computePipeline(*device_, "penumbra_trace.comp", std::span(&bvh, isBvh ? 1 : 0));
    const GBuffer& g = *frame.g;
    graph::Pass pass = graph.add("area shadow rays");
    pass.read(g.depth, Use::Sampled);
    pass.read(g.normals, Use::Sampled);
    pass.read(frame.posed->scene, frame.posed->sceneUse);
    const graph::BufferRef rays =
        pass.createBuffer("area shadow rays", range.count() * frame.pixels.count() * sizeof(shader::ShadowRay), Use::StorageWrite);
    pass.record([&pipeline, g, range, rays, area = frame.area, scene = frame.scene->tracedAddress(), slot = frame.slot,
                 pixels = frame.pixels](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::PenumbraTrace{.area = area,
                                                .scene = scene,
                                                .rays = recorder.address(rays),
                                                .frame = slot,
                                                .depth = recorder.sampled(g.depth),
                                                .normals = recorder.sampled(g.normals),
                                                .firstLight = range.first,
                                                .endLight = range.end,
                                                .pixelScale = static_cast<int>(pixels.scale)},
                          pixels.extent, kGroup);
    });
    return rays;
}

graph::BufferRef PenumbraSystem::declareSearch(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range,
                                               graph::BufferRef rays)
{
    const bool isTwoSided = range.shadow == scene::LightShadow::TwoSided;
    gpu::Pipeline& pipeline = search_[isTwoSided ? 1 : 0];
    constexpr gpu::ShaderDefine twoSided{"TWO_SIDED"};
    if (!pipeline)
        pipeline = computePipeline(*device_, "penumbra_search.comp", std::span(&twoSided, isTwoSided ? 1 : 0));
    graph::Pass pass = graph.add("area penumbra");
    pass.read(frame.g->depth, Use::Sampled);
    pass.read(rays, Use::StorageRead);
    const graph::BufferRef shares =
        pass.createBuffer("area penumbra", range.count() * frame.pixels.count() * sizeof(vec2), Use::StorageWrite);
    pass.record([&pipeline, range, rays, shares, depth = frame.g->depth, area = frame.area, slot = frame.slot,
                 pixels = frame.pixels](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::PenumbraSearch{.area = area,
                                                 .rays = recorder.address(rays),
                                                 .shares = recorder.address(shares),
                                                 .frame = slot,
                                                 .depth = recorder.sampled(depth),
                                                 .firstLight = range.first,
                                                 .endLight = range.end,
                                                 .pixelScale = static_cast<int>(pixels.scale)},
                          pixels.extent, kGroup);
    });
    return shares;
}

graph::BufferRef PenumbraSystem::declare(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range)
{
    return declareSearch(graph, frame, range, declareTrace(graph, frame, range));
}

} // namespace antumbra::render
