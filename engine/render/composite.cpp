#include "render/composite.h"

namespace antumbra::render {

namespace {

using graph::Use;

uint32_t viewOf(ViewMode mode) { return static_cast<uint32_t>(mode); }
static_assert(static_cast<uint32_t>(ViewMode::Final) == shader::kViewFinal && static_cast<uint32_t>(ViewMode::Reference) == shader::kViewReference);
static_assert(static_cast<uint32_t>(ViewMode::Difference) == shader::kViewDifference && static_cast<uint32_t>(ViewMode::Cones) == shader::kViewCones);

} // namespace

CompositeSystem::CompositeSystem(gpu::Device& device) : device_(&device), final_(computePipeline(device, "composite.comp")) {}

Composed CompositeSystem::declare(graph::FrameGraph& graph, const FrameView& view, const FrameAddresses& addresses, const GBuffer& g,
                                  graph::ImageRef occluded, graph::ImageRef reference, graph::BufferRef& counters, bool wantsIrradiance)
{
    const bool explains = view.knobs.view != ViewMode::Final;
    if (explains && !explaining_) {
        constexpr gpu::ShaderDefine define{"EXPLAINS"};
        explaining_ = computePipeline(*device_, "composite.comp", std::span(&define, 1));
    }
    const gpu::Pipeline& pipeline = explains ? explaining_ : final_;
    graph::Pass pass = graph.add("composite");
    for (const graph::ImageRef image : {g.depth, g.normals, g.albedo, g.unshadowed})
        pass.read(image, Use::Sampled);
    if (occluded)
        pass.read(occluded, Use::Sampled);
    if (reference)
        pass.read(reference, Use::Sampled);
    counters = pass.write(counters, Use::StorageWrite);
    const graph::ImageDesc desc{.format = gpu::Format::Rgba16Float, .like = g.depth};
    Composed composed;
    composed.color = pass.create("color", desc, Use::StorageWrite);
    if (wantsIrradiance)
        composed.irradiance = pass.create("irradiance", desc, Use::StorageWrite);

    pass.record([&pipeline, &view, addresses, g, occluded, reference, composed, counted = counters](graph::Recorder& recorder) {
        const auto slot = [&](graph::ImageRef image) { return image ? recorder.sampled(image) : shader::kNoOcclusion; };
        recorder.dispatch(pipeline,
                          shader::Composite{.counters = recorder.address(counted),
                                            .frame = addresses.frame,
                                            .depth = recorder.sampled(g.depth),
                                            .normals = recorder.sampled(g.normals),
                                            .albedo = recorder.sampled(g.albedo),
                                            .unshadowed = recorder.sampled(g.unshadowed),
                                            .occluded = slot(occluded),
                                            .reference = slot(reference),
                                            .color = recorder.storage(composed.color),
                                            .irradiance = composed.irradiance ? recorder.storage(composed.irradiance) : 0,
                                            .view = viewOf(view.knobs.view),
                                            .splitX = view.splitColumn,
                                            .hasIrradiance = composed.irradiance ? 1u : 0u},
                          recorder.extent(composed.color));
    });
    return composed;
}

} // namespace antumbra::render
