#include "render/shadow/ratio_shadow.h"

namespace antumbra::render {

namespace {

using graph::Use;

} // namespace

void RatioShadowSystem::skip(graph::FrameGraph& graph, std::string_view reason)
{
    graph.skip("area ratio trace", reason);
    graph.skip("area ratio denoise", reason);
}

const gpu::Pipeline& RatioShadowSystem::tracePipeline(RayBackend backend, bool isGlossy)
{
    const bool isBvh = backend == RayBackend::ComputeBvh;
    gpu::Pipeline& pipeline = trace_[(isBvh ? 2 : 0) + (isGlossy ? 1 : 0)];
    if (!pipeline) {
        std::vector<gpu::ShaderDefine> defines;
        if (isBvh)
            defines.push_back({"COMPUTE_BVH"});
        if (isGlossy)
            defines.push_back({"GLOSSY"});
        pipeline = computePipeline(*device_, "ratio_trace.comp", defines);
    }
    return pipeline;
}

graph::BufferRef RatioShadowSystem::declareTrace(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range)
{
    const GBuffer& g = *frame.g;
    graph::Pass pass = graph.add("area ratio trace");
    for (const graph::ImageRef image : {g.depth, g.normals, g.albedo, g.material})
        if (image)
            pass.read(image, Use::Sampled);
    pass.read(frame.posed->scene, frame.posed->sceneUse);
    const graph::BufferRef samples =
        pass.createBuffer("area ratio", range.count() * frame.pixels.count() * sizeof(shader::RatioSample), Use::StorageWrite);
    pass.record([&pipeline = tracePipeline(frame.scene->backend(), frame.isGlossy), g, range, samples, area = frame.area,
                 scene = frame.scene->tracedAddress(), slot = frame.slot, pixels = frame.pixels,
                 rays = frame.view->knobs.area.rays](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::RatioTrace{.area = area,
                                             .scene = scene,
                                             .samples = recorder.address(samples),
                                             .frame = slot,
                                             .depth = recorder.sampled(g.depth),
                                             .normals = recorder.sampled(g.normals),
                                             .albedo = recorder.sampled(g.albedo),
                                             .material = g.material ? recorder.sampled(g.material) : 0,
                                             .firstLight = range.first,
                                             .endLight = range.end,
                                             .rays = rays,
                                             .pixelScale = static_cast<int>(pixels.scale)},
                          pixels.extent, {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
    return samples;
}

graph::BufferRef RatioShadowSystem::declareDenoise(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range,
                                                   graph::BufferRef samples, int spacing, bool isLast)
{
    gpu::Pipeline& pipeline = denoise_[isLast ? 1 : 0];
    constexpr gpu::ShaderDefine last{"LAST"};
    if (!pipeline)
        pipeline = computePipeline(*device_, "ratio_denoise.comp", std::span(&last, isLast ? 1 : 0));
    const GBuffer& g = *frame.g;
    graph::Pass pass = graph.add("area ratio denoise");
    pass.read(g.depth, Use::Sampled);
    pass.read(g.normals, Use::Sampled);
    pass.read(samples, Use::StorageRead);
    const size_t bytes = isLast ? sizeof(vec2) : sizeof(shader::RatioSample);
    const graph::BufferRef denoised =
        pass.createBuffer("area ratio, denoised", range.count() * frame.pixels.count() * bytes, Use::StorageWrite);
    pass.record([&pipeline, g, samples, denoised, spacing, slot = frame.slot, pixels = frame.pixels,
                 count = range.count()](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::RatioDenoise{.samples = recorder.address(samples),
                                               .denoised = recorder.address(denoised),
                                               .frame = slot,
                                               .depth = recorder.sampled(g.depth),
                                               .normals = recorder.sampled(g.normals),
                                               .lightCount = count,
                                               .spacing = spacing,
                                               .pixelScale = static_cast<int>(pixels.scale)},
                          pixels.extent, {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
    return denoised;
}

graph::BufferRef RatioShadowSystem::declare(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range)
{
    const graph::BufferRef samples = declareTrace(graph, frame, range);
    const graph::BufferRef smoother = declareDenoise(graph, frame, range, samples, 1, false);
    return declareDenoise(graph, frame, range, smoother, 2, true);
}

} // namespace antumbra::render
