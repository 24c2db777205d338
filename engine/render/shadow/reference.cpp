#include "render/shadow/reference.h"

#include "render/shadow/fingerprint.h"

namespace antumbra::render {

namespace {

using graph::Use;

constexpr gpu::Format kMeanFormat = gpu::Format::Rgba32Float;

uint32_t wantedSamples(const Knobs& knobs)
{
    if (knobs.reference.samples > 0)
        return knobs.reference.samples;
    return knobs.view == ViewMode::Difference || knobs.view == ViewMode::Reference ? kLiveSamples : 0;
}

} // namespace

graph::ImageRef ReferenceSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene,
                                         const FieldFrame& fields, const Baked& baked, const Grounds& grounds, const GBuffer& g,
                                         const Posed& posed)
{
    const uint32_t wanted = wantedSamples(view.knobs);
    if (wanted == 0 || !view.hidesEnvironment()) {
        const std::string_view reason = wanted == 0 ? "reference.samples is 0" : view.whyNothingHides();
        graph.skip("reference trace", reason);
        graph.skip("reference accumulate", reason);
        frames_ = 0;
        isActive_ = false;
        return {};
    }
    const gpu::Pipeline& trace =
        trace_.of({.backend = scene.backend(), .culling = Culling::None, .isReference = true, .isLocal = static_cast<bool>(baked)}, fields);
    if (!accumulate_)
        accumulate_ = computePipeline(*device_, "reference_accumulate.comp");
    const uvec2 extent = graph.extent(g.depth);
    const graph::History history = graph.history("reference mean", {.format = kMeanFormat, .extent = extent}, history_);
    const uint64_t now = fingerprintOf(view, scene.backend(), extent, fields.isLate);
    if (now != seen_ || !history.valid)
        frames_ = 0;
    seen_ = now;
    samplesAFrame_ = kSamplesAFrame;
    isActive_ = true;

    graph::ImageRef traced;
    if (frames_ * kSamplesAFrame < wanted) {
        graph::Pass pass = graph.add("reference trace");
        pass.read(g.depth, Use::Sampled);
        pass.read(g.normals, Use::Sampled);
        pass.read(posed.scene, posed.sceneUse);
        if (baked)
            pass.read(baked.cells, Use::StorageRead);
        if (grounds)
            pass.read(grounds.blocks, Use::StorageRead);
        traced = pass.create("reference, traced", {.format = kMeanFormat, .like = g.depth}, Use::StorageWrite);
        const graph::BufferRef own = pass.createBuffer("reference counters", sizeof(shader::CounterBlock), Use::StorageWrite);
        pass.record([&trace, &scene, frame, fields = fields.address, grounds, g, traced, own, summed = frames_](graph::Recorder& recorder) {
            recorder.dispatch(trace,
                              shader::OcclusionTrace{.scene = scene.tracedAddress(),
                                                     .counters = recorder.address(own),
                                                     .fields = fields,
                                                     .grounds = grounds ? recorder.address(grounds.blocks) : 0,
                                                     .frame = frame,
                                                     .depth = recorder.sampled(g.depth),
                                                     .normals = recorder.sampled(g.normals),
                                                     .occluded = recorder.storage(traced),
                                                     .sampleCount = kSamplesAFrame,
                                                     .groundCount = grounds.count,
                                                     .pixelScale = 1.0f,
                                                     .frameIndex = summed,
                                                     .padding = 0},
                              recorder.extent(traced), {shader::kTraceGroupWidth, shader::kTraceGroupHeight});
        });
    } else {
        graph.skip("reference trace", "reference.samples are reached");
    }

    graph::Pass pass = graph.add("reference accumulate");
    pass.read(history.before, Use::Sampled);
    if (traced)
        pass.read(traced, Use::Sampled);
    const graph::ImageRef mean = pass.write(history.now, Use::StorageWrite);
    pass.record([this, history, traced, mean, summed = frames_](graph::Recorder& recorder) {
        recorder.dispatch(accumulate_,
                          shader::ReferenceAccumulate{.now = recorder.storage(mean),
                                                      .before = recorder.sampled(history.before),
                                                      .traced = traced ? recorder.sampled(traced) : shader::kNothingTraced,
                                                      .frameCount = summed},
                          recorder.extent(mean));
    });
    frames_ += traced ? 1 : 0;
    return mean;
}

} // namespace antumbra::render
