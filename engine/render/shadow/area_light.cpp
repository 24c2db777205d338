#include "render/shadow/area_light.h"

#include "bake/ltc.h"
#include "render/frame_copy.h"
#include "render/shadow/fingerprint.h"

#include <algorithm>

namespace antumbra::render {

namespace {

using graph::Use;
using scene::LightShadow;

constexpr gpu::Format kMeanFormat = gpu::Format::Rgba32Float;

std::string_view passOf(LightShadow shadow)
{
    switch (shadow) {
    case LightShadow::None: return "area unshadowed";
    case LightShadow::Triangles: return "area triangles";
    case LightShadow::Traced: return "area traced";
    case LightShadow::Reference: return "area reference";
    case LightShadow::Ratio: return "area ratio";
    case LightShadow::Article: return "area article";
    case LightShadow::TwoSided: return "area two-sided";
    default: return "area analytic";
    }
}

gpu::Image uploadedTable(gpu::Device& device, std::string_view label, uint32_t size, const std::vector<vec4>& texels)
{
    return gpu::uploadedImage(device, label, {.format = gpu::Format::Rgba32Float, .extent = uvec2(size)}, std::as_bytes(std::span(texels)));
}

/// By the occluders that are before a light.
bool isTiled(LightShadow shadow) { return shadow == LightShadow::Analytic || shadow == LightShadow::Triangles; }

uint32_t wantedSamples(const Knobs& knobs) { return knobs.reference.samples > 0 ? knobs.reference.samples : kLiveSamples; }

} // namespace

std::optional<uint32_t> AreaLightSystem::referenceSamples() const
{
    return hasReference_ ? std::optional(referenceFrames_ * kSamplesAFrame) : std::nullopt;
}

void AreaLightSystem::prepareTables(bool isGlossy)
{
    if (!isGlossy) {
        ltcMatrix_ = {};
        ltcAmplitude_ = {};
    } else if (!ltcMatrix_) {
        const bake::LtcTables tables = bake::loadLtcTables(projectPath("assets") / "fits");
        ltcMatrix_ = uploadedTable(*device_, "LTC matrix", tables.size, tables.matrix);
        ltcAmplitude_ = uploadedTable(*device_, "LTC amplitude", tables.size, tables.amplitude);
    }
}

void AreaLightSystem::declareTiles(graph::FrameGraph& graph, const LitFrame& frame, uvec2 tileCount)
{
    if (!tiles_)
        tiles_ = computePipeline(*device_, "area_tiles.comp");
    const uint32_t count = tileCount.x * tileCount.y;
    graph::Pass pass = graph.add("area tiles");
    pass.read(frame.g->depth, Use::Sampled);
    occluderTiles_ =
        pass.createBuffer("area tiles", size_t{count} * bodies_.lightCount() * sizeof(shader::AreaTileBlock), Use::StorageWrite);
    pass.record(
        [this, area = frame.area, slot = frame.slot, depth = frame.g->depth, tiles = occluderTiles_, count](graph::Recorder& recorder) {
            recorder.dispatch(tiles_,
                              shader::AreaTiles{.area = area,
                                                .tiles = recorder.address(tiles),
                                                .frame = slot,
                                                .depth = recorder.sampled(depth),
                                                .tileCount = count,
                                                .padding = 0},
                              {count, 1}, {64, 1});
        });
}

graph::BufferRef AreaLightSystem::declareShares(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range)
{
    if (!isShare(range.shadow))
        return {};
    return range.shadow == LightShadow::Ratio ? ratioShadows_.declare(graph, frame, range) : penumbras_.declare(graph, frame, range);
}

void AreaLightSystem::declareShade(graph::Pass& pass, const LitFrame& frame, const AreaLightRange& range, const Shading& shading,
                                   graph::BufferRef counters)
{
    const GBuffer& g = *frame.g;
    for (const graph::ImageRef image : {g.depth, g.normals, g.albedo, g.material, shading.before.diffuse, shading.before.specular})
        if (image)
            pass.read(image, Use::Sampled);
    const bool isTraced = traces(range.shadow), hasTiles = isTiled(range.shadow);
    const graph::BufferRef tiles = hasTiles ? occluderTiles_ : graph::BufferRef{};
    const graph::BufferRef seenPastFields = isTraced ? graph::BufferRef{} : seenPastFields_; // rays meet fields themselves
    for (const graph::BufferRef buffer : {tiles, shading.shares, seenPastFields})
        if (buffer)
            pass.read(buffer, Use::StorageRead);
    if (isTraced)
        pass.read(frame.posed->scene, frame.posed->sceneUse);
    const gpu::Pipeline& pipeline = pipelines_.shade({.shadow = range.shadow,
                                                      .isGlossy = frame.isGlossy,
                                                      .backend = isTraced ? frame.scene->backend() : RayBackend::Auto,
                                                      .sizes = bodies_.sizes()},
                                                     *frame.fields);
    const VkDeviceAddress traced = isTraced ? frame.scene->tracedAddress() : 0;
    pass.record([this, &pipeline, area = frame.area, slot = frame.slot, scale = frame.pixels.scale, g, range, shading, tiles, counters,
                 traced, seen = seenPastFields, knobs = frame.view->knobs.area](graph::Recorder& recorder) {
        const auto sampled = [&](graph::ImageRef image) { return image ? recorder.sampled(image) : shader::kNothingBefore; };
        const auto address = [&](graph::BufferRef buffer) { return buffer ? recorder.address(buffer) : 0; };
        recorder.dispatch(pipeline,
                          shader::AreaShade{.area = area,
                                            .tiles = address(tiles),
                                            .counters = recorder.address(counters),
                                            .scene = traced,
                                            .shares = address(shading.shares),
                                            .seenPastFields = address(seen),
                                            .frame = slot,
                                            .depth = recorder.sampled(g.depth),
                                            .normals = recorder.sampled(g.normals),
                                            .albedo = recorder.sampled(g.albedo),
                                            .material = sampled(g.material),
                                            .ltcMatrix = ltcMatrix_.sampledSlot(),
                                            .ltcAmplitude = ltcAmplitude_.sampledSlot(),
                                            .diffuse = recorder.storage(shading.made.diffuse),
                                            .specular = shading.made.specular ? recorder.storage(shading.made.specular) : 0,
                                            .diffuseBefore = sampled(shading.before.diffuse),
                                            .specularBefore = sampled(shading.before.specular),
                                            .firstLight = range.first,
                                            .endLight = range.end,
                                            .mostPieces = knobs.pieces,
                                            .mostPlanes = static_cast<int>(knobs.planes),
                                            .rays = shading.rays,
                                            .frameIndex = shading.frameIndex,
                                            .pixelScale = static_cast<int>(scale)},
                          recorder.extent(shading.made.diffuse), {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
}

AreaLit AreaLightSystem::declareReference(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range,
                                          graph::BufferRef& counters)
{
    const uvec2 extent = graph.extent(frame.g->depth);
    const graph::ImageDesc desc{.format = kMeanFormat, .extent = extent};
    const graph::History diffuse = graph.history("area reference, diffuse", desc, diffuseHistory_);
    const graph::History specular = frame.isGlossy ? graph.history("area reference, specular", desc, specularHistory_) : graph::History{};
    const uint64_t now = fingerprintOf(*frame.view, frame.scene->backend(), extent, frame.fields->isLate);
    if (now != seen_ || !diffuse.valid)
        referenceFrames_ = 0;
    seen_ = now;
    const bool isDone = referenceFrames_ * kSamplesAFrame >= wantedSamples(frame.view->knobs);
    graph::Pass pass = graph.add(passOf(range.shadow));
    counters = pass.write(counters, Use::StorageWrite);
    const AreaLit mean{pass.write(diffuse.now, Use::StorageWrite),
                       frame.isGlossy ? pass.write(specular.now, Use::StorageWrite) : graph::ImageRef{}};
    declareShade(pass, frame, range,
                 {.before = referenceFrames_ > 0 ? AreaLit{diffuse.before, specular.before} : AreaLit{},
                  .made = mean,
                  .shares = {},
                  .rays = isDone ? 0 : kSamplesAFrame,
                  .frameIndex = referenceFrames_},
                 counters);
    referenceFrames_ += isDone ? 0 : 1;
    return mean;
}

AreaLit AreaLightSystem::declareLights(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range, const AreaLit& before,
                                       graph::BufferRef& counters)
{
    const graph::BufferRef shares = declareShares(graph, frame, range);
    graph::Pass pass = graph.add(passOf(range.shadow));
    counters = pass.write(counters, Use::StorageWrite);
    const graph::ImageDesc desc{.format = AreaLit::kFormat, .like = frame.g->depth, .scale = 1.0f / static_cast<float>(frame.pixels.scale)};
    const AreaLit made{pass.create("area diffuse", desc, Use::StorageWrite),
                       frame.isGlossy ? pass.create("area specular", desc, Use::StorageWrite) : graph::ImageRef{}, frame.pixels.scale};
    declareShade(pass, frame, range, {.before = before, .made = made, .shares = shares, .rays = frame.view->knobs.area.rays}, counters);
    return made;
}

void AreaLightSystem::skipAll(graph::FrameGraph& graph)
{
    constexpr std::string_view reason = "no AreaLight in the scene";
    for (const std::string_view pass : {"area tiles", "area analytic", "area triangles", "area unshadowed", "area traced", "area reference",
                                        "area ratio", "area article", "area two-sided"})
        graph.skip(pass, reason);
    skipFieldShadow(graph, reason);
    RatioShadowSystem::skip(graph, reason);
    PenumbraSystem::skip(graph, reason);
    prepareTables(false);
}

AreaLit AreaLightSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t slot, const GpuScene& scene,
                                 const FieldFrame& fields, const GBuffer& g, const Posed& posed, graph::BufferRef& counters)
{
    hasReference_ = false;
    probe_.beginFrame();
    if (view.areaLights.empty()) {
        skipAll(graph);
        return {};
    }
    const uvec2 extent = graph.extent(g.depth), tileCount = (extent + shader::kAreaTileSize - 1u) / shader::kAreaTileSize;
    const auto scale = static_cast<uint32_t>(view.hasReferenceLights() ? Scale::Full : view.knobs.area.scale);
    const LitFrame frame{.view = &view,
                         .scene = &scene,
                         .g = &g,
                         .posed = &posed,
                         .fields = &fields,
                         .area = bodies_.write(view, tileCount.x, fields.address),
                         .pixels = {.extent = (extent + scale - 1u) / scale, .scale = scale},
                         .slot = slot,
                         .isGlossy = static_cast<bool>(g.material)};
    prepareTables(frame.isGlossy);
    seenPastFields_ = declareFieldShadow(graph, frame, bodies_.ranges(), counters);
    if (view.probedPixel)
        probe_.declare(graph, slot, g, frame.area, *view.probedPixel, view.knobs.area.planes);
    if (std::ranges::any_of(bodies_.ranges(), isTiled, &AreaLightRange::shadow))
        declareTiles(graph, frame, tileCount);
    AreaLit lit;
    for (const AreaLightRange& range : bodies_.ranges()) {
        hasReference_ = hasReference_ || range.shadow == LightShadow::Reference;
        lit = range.shadow == LightShadow::Reference ? declareReference(graph, frame, range, counters)
                                                     : declareLights(graph, frame, range, lit, counters);
    }
    return lit;
}

} // namespace antumbra::render
