#include "render/composite.h"

#include <array>

namespace antumbra::render {

namespace {

using graph::Use;

constexpr gpu::Format kColorFormat = gpu::Format::Rgba16Float;

uint32_t viewOf(ViewMode mode) { return static_cast<uint32_t>(mode); }
static_assert(static_cast<uint32_t>(ViewMode::Final) == shader::kViewFinal &&
              static_cast<uint32_t>(ViewMode::Reference) == shader::kViewReference);
static_assert(static_cast<uint32_t>(ViewMode::Difference) == shader::kViewDifference &&
              static_cast<uint32_t>(ViewMode::Cones) == shader::kViewCones);

} // namespace

CompositeSystem::CompositeSystem(gpu::Device& device) : device_(&device), final_(computePipeline(device, "composite.comp"))
{
    constexpr std::array formats{kColorFormat};
    sky_ = rasterPipeline(device, {.vertexShader = "sky.vert",
                                   .fragmentShader = "sky.frag",
                                   .colorFormats = formats,
                                   .depthFormat = gpu::Format::Depth32Float,
                                   .writesDepth = false});
}

Composed CompositeSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GBuffer& g,
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
    const graph::ImageDesc desc{.format = kColorFormat, .like = g.depth};
    Composed composed;
    composed.color = pass.create("color", desc, Use::StorageWrite);
    if (wantsIrradiance)
        composed.irradiance = pass.create("irradiance", desc, Use::StorageWrite);

    pass.record([&pipeline, &view, frame, g, occluded, reference, composed, counted = counters](graph::Recorder& recorder) {
        const auto slot = [&](graph::ImageRef image) { return image ? recorder.sampled(image) : shader::kNoOcclusion; };
        recorder.dispatch(pipeline,
                          shader::Composite{.counters = recorder.address(counted),
                                            .frame = frame,
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

    graph::Pass sky = graph.add("sky");
    sky.read(g.depth, Use::DepthRead);
    composed.color = sky.write(composed.color, Use::ColorAttachment);
    sky.record([this, frame](graph::Recorder& recorder) { recorder.draw(sky_, shader::Sky{.frame = frame}, 3); });
    return composed;
}

} // namespace antumbra::render
