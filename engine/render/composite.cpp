#include "render/composite.h"

namespace antumbra::render {

namespace {

using graph::ImageRef;
using graph::Use;

constexpr gpu::Format kPictureFormat = gpu::Format::Rgba8Unorm;
constexpr gpu::Format kKeptFormat = gpu::Format::Rgba16Float;

uint32_t viewOf(ViewMode mode) { return static_cast<uint32_t>(mode); }
static_assert(static_cast<uint32_t>(ViewMode::Final) == shader::kViewFinal &&
              static_cast<uint32_t>(ViewMode::Reference) == shader::kViewReference);
static_assert(static_cast<uint32_t>(ViewMode::Difference) == shader::kViewDifference &&
              static_cast<uint32_t>(ViewMode::Cones) == shader::kViewCones);

} // namespace

const gpu::Pipeline& CompositeSystem::composition(bool isOccluded, bool explains)
{
    gpu::Pipeline& pipeline = compositions_[(isOccluded ? 1u : 0u) + (explains ? 2u : 0u)];
    if (!pipeline) {
        std::vector<gpu::ShaderDefine> defines;
        if (isOccluded)
            defines.push_back({"OCCLUDED"});
        if (explains)
            defines.push_back({"EXPLAINS"});
        pipeline = computePipeline(*device_, "composite.comp", defines);
    }
    return pipeline;
}

const gpu::Pipeline& CompositeSystem::sky(bool keepsColor)
{
    gpu::Pipeline& pipeline = skies_[keepsColor ? 1 : 0];
    if (!pipeline) {
        constexpr std::array formats{kPictureFormat, kKeptFormat};
        constexpr gpu::ShaderDefine define{"KEEPS_COLOR"};
        pipeline = rasterPipeline(*device_, {.vertexShader = "sky.vert",
                                             .fragmentShader = "sky.frag",
                                             .defines = std::span(&define, keepsColor ? 1 : 0),
                                             .colorFormats = std::span(formats).first(keepsColor ? 2 : 1),
                                             .depthFormat = gpu::Format::Depth32Float,
                                             .writesDepth = false});
    }
    return pipeline;
}

Composed CompositeSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GBuffer& g, const Traced& traced,
                                  ImageRef reference, ImageRef picture, Kept kept, graph::BufferRef& counters)
{
    const bool explains = view.knobs.view != ViewMode::Final || kept.any() || reference;
    graph::Pass pass = graph.add("composite");
    for (const ImageRef image : {g.depth, g.normals, g.albedo, g.unshadowed})
        pass.read(image, Use::Sampled);
    for (const ImageRef image : {traced.pixels, reference})
        if (image)
            pass.read(image, Use::Sampled);
    counters = pass.write(counters, Use::StorageWrite);
    const auto create = [&](bool isKept, std::string_view name) {
        return isKept ? pass.create(name, {.format = kKeptFormat, .like = g.depth}, Use::StorageWrite) : ImageRef{};
    };
    Composed composed{.picture = pass.write(picture, Use::StorageWrite),
                      .color = create(kept.color, "color"),
                      .irradiance = create(kept.irradiance, "irradiance"),
                      .occluded = create(kept.occluded, "occluded")};

    const gpu::Pipeline& pipeline = composition(static_cast<bool>(traced.pixels), explains);
    pass.record([&pipeline, &view, frame, g, traced, reference, composed, counted = counters](graph::Recorder& recorder) {
        const auto sampled = [&](ImageRef image) { return image ? recorder.sampled(image) : shader::kAbsent; };
        const auto storage = [&](ImageRef image) { return image ? recorder.storage(image) : shader::kAbsent; };
        const uint32_t scale = traced.pixelScale;
        recorder.dispatch(pipeline,
                          shader::Composite{.counters = recorder.address(counted),
                                            .frame = frame,
                                            .depth = recorder.sampled(g.depth),
                                            .normals = recorder.sampled(g.normals),
                                            .albedo = recorder.sampled(g.albedo),
                                            .unshadowed = recorder.sampled(g.unshadowed),
                                            .traced = sampled(traced.pixels),
                                            .pixelScale = static_cast<int>(scale),
                                            .lastTraced = traced.pixels ? ivec2(recorder.extent(traced.pixels)) - 1 : ivec2(0),
                                            .reference = sampled(reference),
                                            .isReferenceShown = view.knobs.reference.samples > 0 && view.knobs.view == ViewMode::Final,
                                            .picture = recorder.storage(composed.picture),
                                            .exposure = view.exposure,
                                            .color = storage(composed.color),
                                            .irradiance = storage(composed.irradiance),
                                            .occluded = storage(composed.occluded),
                                            .view = viewOf(view.knobs.view),
                                            .splitX = view.splitColumn},
                          recorder.extent(composed.picture) / scale + 2u);
    });

    graph::Pass sky = graph.add("sky");
    sky.read(g.depth, Use::DepthRead);
    composed.picture = sky.write(composed.picture, Use::ColorAttachment);
    if (kept.color)
        composed.color = sky.write(composed.color, Use::ColorAttachment);
    sky.record([&drawn = this->sky(kept.color), frame, exposure = view.exposure](graph::Recorder& recorder) {
        recorder.draw(drawn, shader::Sky{.frame = frame, .exposure = exposure}, 3);
    });
    return composed;
}

} // namespace antumbra::render
