#include "render/shadow/occlusion.h"

#include "render/shadow/samples.h"

namespace antumbra::render {

namespace {

using graph::Use;

constexpr gpu::Format kTracedFormat = gpu::Format::Rgba32Uint; // as in lib/traced.glsl

} // namespace

void OcclusionSystem::prepare(const OcclusionKnobs& knobs)
{
    if (knobs.filter > 0 && !filter_)
        filter_ = computePipeline(*device_, "occlusion_filter.comp");
    if (sampleCount_ == knobs.samples)
        return;
    const std::vector<vec3> samples = hemisphereSamples(knobs.samples);
    samples_ = gpu::uploadedBuffer(*device_, "hemisphere samples", std::span<const vec3>(samples));
    sampleCount_ = knobs.samples;
}

graph::ImageRef OcclusionSystem::declareTrace(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene,
                                              const FieldFrame& fields, const Baked& baked, const Grounds& grounds, const GBuffer& g,
                                              const Posed& posed, graph::BufferRef& counters)
{
    const OcclusionKnobs& knobs = view.knobs.occlusion;
    const auto pixelScale = static_cast<float>(knobs.scale);
    graph::Pass pass = graph.add("occlusion trace");
    pass.read(g.depth, Use::Sampled);
    pass.read(g.normals, Use::Sampled);
    pass.read(posed.scene, posed.sceneUse);
    if (posed.bounds)
        pass.read(posed.bounds, Use::StorageRead);
    if (baked)
        pass.read(baked.cells, Use::StorageRead);
    if (grounds)
        pass.read(grounds.blocks, Use::StorageRead);
    counters = pass.write(counters, Use::StorageWrite);
    const graph::ImageRef traced =
        pass.create("occluded, traced", {.format = kTracedFormat, .like = g.depth, .scale = 1.0f / pixelScale}, Use::StorageWrite);

    const gpu::Pipeline& pipeline = trace_.of(
        {.backend = scene.backend(), .culling = knobs.culling, .isReference = false, .isLocal = static_cast<bool>(baked)}, fields);
    pass.record([this, &view, &scene, &pipeline, frame, fields = fields.address, grounds, g, traced, pixelScale,
                 counted = counters](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::OcclusionTrace{.scene = scene.tracedAddress(),
                                                 .samples = samples_.address(),
                                                 .counters = recorder.address(counted),
                                                 .blockers = scene.blockers().address(),
                                                 .capsules = scene.capsules().address(),
                                                 .fields = fields,
                                                 .grounds = grounds ? recorder.address(grounds.blocks) : 0,
                                                 .frame = frame,
                                                 .depth = recorder.sampled(g.depth),
                                                 .normals = recorder.sampled(g.normals),
                                                 .occluded = recorder.storage(traced),
                                                 .isFiltered = view.knobs.occlusion.filter > 0 ? 1u : 0u,
                                                 .sampleCount = view.knobs.occlusion.samples,
                                                 .blockerCount = static_cast<uint32_t>(view.characters.size()),
                                                 .groundCount = grounds.count,
                                                 .tolerance = view.knobs.occlusion.tolerance,
                                                 .pixelScale = pixelScale,
                                                 .frameIndex = 0,
                                                 .padding = 0},
                          recorder.extent(traced), {shader::kTraceGroupWidth, shader::kTraceGroupHeight});
    });
    return traced;
}

graph::ImageRef OcclusionSystem::declareFilter(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GBuffer& g,
                                               graph::ImageRef traced)
{
    const OcclusionKnobs& knobs = view.knobs.occlusion;
    if (knobs.filter == 0) {
        graph.skip("occlusion filter", "occlusion.filter is 0");
        return traced;
    }
    graph::Pass pass = graph.add("occlusion filter");
    pass.read(traced, Use::Sampled);
    const graph::ImageRef filtered = pass.create("occluded, filtered", {.format = kTracedFormat, .like = traced}, Use::StorageWrite);
    pass.record([this, &knobs, frame, traced, filtered, last = graph.extent(g.depth) - 1u](graph::Recorder& recorder) {
        recorder.dispatch(filter_,
                          shader::OcclusionFilter{.frame = frame,
                                                  .traced = recorder.sampled(traced),
                                                  .filtered = recorder.storage(filtered),
                                                  .radius = static_cast<int>(knobs.filter / 2),
                                                  .pixelScale = static_cast<float>(knobs.scale),
                                                  .lastPixel = last},
                          recorder.extent(filtered));
    });
    return filtered;
}

Traced OcclusionSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene,
                                const FieldFrame& fields, const Baked& baked, const Grounds& grounds, const GBuffer& g, const Posed& posed,
                                graph::BufferRef& counters)
{
    if (!view.hidesEnvironment()) {
        for (const std::string_view pass : {"occlusion trace", "occlusion filter"})
            graph.skip(pass, view.whyNothingHides());
        return {};
    }
    if (view.knobs.occlusion.backend == RayBackend::RayQuery && scene.backend() != RayBackend::RayQuery)
        graph.skip("occlusion trace, ray-query", "the device has no ray queries: compute-bvh traces instead");
    prepare(view.knobs.occlusion);
    const graph::ImageRef traced = declareTrace(graph, view, frame, scene, fields, baked, grounds, g, posed, counters);
    return {declareFilter(graph, view, frame, g, traced), static_cast<uint32_t>(view.knobs.occlusion.scale)};
}

} // namespace antumbra::render
