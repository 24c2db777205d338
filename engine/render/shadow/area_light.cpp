#include "render/shadow/area_light.h"

#include "bake/ltc.h"
#include "render/shadow/fingerprint.h"

#include <algorithm>
#include <bit>

namespace antumbra::render {

namespace {

using graph::Use;
using scene::LightShadow;

constexpr uint32_t kOccludersALight = 8;  // of a pixel in closed form; and as many of them may overlap
constexpr uint32_t kTrianglesALight = 64; // of a pixel, where bodies are taken as these
constexpr uint32_t kTriangleEdges = 4;    // one is made where the light's plane cuts it
constexpr uint32_t kCutsAPolygon = 12;    // corners that it may gain
constexpr uint32_t kMostPolygonCorners = 64;
constexpr uint32_t kMostSilhouetteEdges = 64;
constexpr gpu::Format kLitFormat = gpu::Format::Rgba16Float;
constexpr gpu::Format kMeanFormat = gpu::Format::Rgba32Float;

std::string_view passOf(LightShadow shadow)
{
    switch (shadow) {
    case LightShadow::None: return "area unshadowed";
    case LightShadow::Triangles: return "area triangles";
    case LightShadow::Traced: return "area traced";
    case LightShadow::Reference: return "area reference";
    default: return "area analytic";
    }
}

int shaderShadowOf(LightShadow shadow)
{
    const bool isTraced = shadow == LightShadow::Traced || shadow == LightShadow::Reference;
    return static_cast<int>(isTraced ? shader::kAreaTraced : shadow == LightShadow::None ? shader::kAreaUnshadowed : shader::kAreaAnalytic);
}

bool traces(LightShadow shadow) { return shadow == LightShadow::Traced || shadow == LightShadow::Reference; }

/// Few different sizes, so that few pipelines are made as lights come and go.
AreaSizes rounded(const AreaSizes& sizes)
{
    return {.isPlanar = sizes.isPlanar,
            .outlineCorners = std::min(std::bit_ceil(sizes.outlineCorners + kCutsAPolygon), kMostPolygonCorners) - kCutsAPolygon,
            .faceCorners = 4,
            .lightVertices = std::bit_ceil(sizes.lightVertices),
            .silhouetteEdges = std::min(std::bit_ceil(sizes.silhouetteEdges), kMostSilhouetteEdges),
            .faces = (sizes.faces + 31) / 32 * 32};
}

/// What is asked for where one face of a light is seen past one triangle after another.
AreaSizes ofTriangles(const AreaSizes& sizes)
{
    return {.outlineCorners = sizes.faceCorners, .silhouetteEdges = kTriangleEdges, .faces = sizes.faces};
}

std::vector<gpu::ShaderDefine> sizeDefines(const AreaSizes& sizes, uint32_t occluders)
{
    const auto polygonCorners = static_cast<int>(sizes.outlineCorners + kCutsAPolygon);
    const auto edges = static_cast<int>(sizes.silhouetteEdges);
    return {{"POLYGON_PLACES", static_cast<int>(kOccludersALight) + 6},
            {"POLYGON_CORNERS", polygonCorners},
            {"SILHOUETTE_EDGES", edges * static_cast<int>(occluders)},
            {"SILHOUETTE_BODY_EDGES", edges},
            {"FACE_WORDS", static_cast<int>(sizes.faces / 32)},
            {"OUTLINE_CORNERS", static_cast<int>(sizes.outlineCorners)},
            {"LIGHT_VERTICES", static_cast<int>(sizes.lightVertices)},
            {"AREA_OCCLUDERS", static_cast<int>(occluders)},
            {"AREA_SIGNED", static_cast<int>(occluders)}};
}

gpu::Image uploadedTable(gpu::Device& device, std::string_view label, uint32_t size, const std::vector<vec4>& texels)
{
    return gpu::uploadedImage(device, label, {.format = gpu::Format::Rgba32Float, .extent = uvec2(size)}, std::as_bytes(std::span(texels)));
}

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

const gpu::Pipeline& AreaLightSystem::pipelineFor(const Variant& variant)
{
    const auto found = std::ranges::find(pipelines_, variant, &Made::variant);
    if (found != pipelines_.end())
        return found->pipeline;
    const bool hasTriangles = variant.shadow == LightShadow::Triangles;
    std::vector<gpu::ShaderDefine> defines = sizeDefines(variant.sizes, hasTriangles ? kTrianglesALight : kOccludersALight);
    defines.push_back({"SHADOW", shaderShadowOf(variant.shadow)});
    if (variant.sizes.isPlanar)
        defines.push_back({"PLANAR_LIGHTS"});
    if (variant.isGlossy)
        defines.push_back({"GLOSSY"});
    if (hasTriangles)
        defines.push_back({"TRIANGLES"});
    if (variant.shadow == LightShadow::Reference)
        defines.push_back({"REFERENCE"});
    if (variant.backend == RayBackend::ComputeBvh)
        defines.push_back({"COMPUTE_BVH"});
    pipelines_.push_back({variant, computePipeline(*device_, "area_shade.comp", defines)});
    return pipelines_.back().pipeline;
}

graph::BufferRef AreaLightSystem::declareTiles(graph::FrameGraph& graph, const Frame& frame, uvec2 tileCount)
{
    if (!tiles_)
        tiles_ = computePipeline(*device_, "area_tiles.comp");
    const uint32_t count = tileCount.x * tileCount.y;
    graph::Pass pass = graph.add("area tiles");
    pass.read(frame.g->depth, Use::Sampled);
    const graph::BufferRef tiles =
        pass.createBuffer("area tiles", size_t{count} * bodies_.lightCount() * sizeof(shader::AreaTileBlock), Use::StorageWrite);
    pass.record([this, area = frame.area, slot = frame.slot, depth = frame.g->depth, tiles, count](graph::Recorder& recorder) {
        recorder.dispatch(tiles_,
                          shader::AreaTiles{.area = area,
                                            .tiles = recorder.address(tiles),
                                            .frame = slot,
                                            .depth = recorder.sampled(depth),
                                            .tileCount = count,
                                            .padding = 0},
                          {count, 1}, {64, 1});
    });
    return tiles;
}

void AreaLightSystem::declareShade(graph::Pass& pass, const Frame& frame, const AreaLightRange& range, const AreaLit& before,
                                   const AreaLit& made, graph::BufferRef counters, uint32_t rays, uint32_t frameIndex, uint32_t scale)
{
    const GBuffer& g = *frame.g;
    for (const graph::ImageRef image : {g.depth, g.normals, g.albedo, g.material, before.diffuse, before.specular})
        if (image)
            pass.read(image, Use::Sampled);
    if (frame.seenPastFields)
        pass.read(frame.seenPastFields, Use::StorageRead);
    const bool isTraced = traces(range.shadow);
    if (isTraced)
        pass.read(frame.posed->scene, frame.posed->sceneUse);
    else if (frame.tiles)
        pass.read(frame.tiles, Use::StorageRead);
    const AreaSizes sizes = isTraced                                 ? AreaSizes{}
                            : range.shadow == LightShadow::Triangles ? ofTriangles(bodies_.sizes())
                                                                     : bodies_.sizes();
    const RayBackend backend = isTraced ? frame.scene->backend() : RayBackend::Auto;
    const gpu::Pipeline& pipeline = pipelineFor({range.shadow, frame.isGlossy, backend, rounded(sizes)});
    const VkDeviceAddress traced = isTraced ? frame.scene->tracedAddress() : 0;
    pass.record([this, &pipeline, area = frame.area, tiles = isTraced ? graph::BufferRef{} : frame.tiles, slot = frame.slot, g, range,
                 before, made, counters, traced, rays, frameIndex, scale, seen = frame.seenPastFields,
                 knobs = frame.view->knobs.area](graph::Recorder& recorder) {
        const auto sampled = [&](graph::ImageRef image) { return image ? recorder.sampled(image) : shader::kNothingBefore; };
        recorder.dispatch(pipeline,
                          shader::AreaShade{.area = area,
                                            .tiles = tiles ? recorder.address(tiles) : 0,
                                            .counters = recorder.address(counters),
                                            .scene = traced,
                                            .seenPastFields = seen ? recorder.address(seen) : 0,
                                            .frame = slot,
                                            .depth = recorder.sampled(g.depth),
                                            .normals = recorder.sampled(g.normals),
                                            .albedo = recorder.sampled(g.albedo),
                                            .material = sampled(g.material),
                                            .ltcMatrix = ltcMatrix_.sampledSlot(),
                                            .ltcAmplitude = ltcAmplitude_.sampledSlot(),
                                            .diffuse = recorder.storage(made.diffuse),
                                            .specular = made.specular ? recorder.storage(made.specular) : 0,
                                            .diffuseBefore = sampled(before.diffuse),
                                            .specularBefore = sampled(before.specular),
                                            .firstLight = range.first,
                                            .endLight = range.end,
                                            .mostPieces = knobs.pieces,
                                            .mostPlanes = static_cast<int>(knobs.planes),
                                            .rays = rays,
                                            .frameIndex = frameIndex,
                                            .pixelScale = static_cast<int>(scale)},
                          recorder.extent(made.diffuse), {shader::kAreaGroupWidth, shader::kAreaGroupHeight});
    });
}

AreaLit AreaLightSystem::declareReference(graph::FrameGraph& graph, const Frame& frame, const AreaLightRange& range,
                                          graph::BufferRef& counters)
{
    const uvec2 extent = graph.extent(frame.g->depth);
    const graph::ImageDesc desc{.format = kMeanFormat, .extent = extent};
    const graph::History diffuse = graph.history("area reference, diffuse", desc, diffuseHistory_);
    const graph::History specular = frame.isGlossy ? graph.history("area reference, specular", desc, specularHistory_) : graph::History{};
    const uint64_t now = fingerprintOf(*frame.view, frame.scene->backend(), extent);
    if (now != seen_ || !diffuse.valid)
        referenceFrames_ = 0;
    seen_ = now;
    const bool isDone = referenceFrames_ * kSamplesAFrame >= wantedSamples(frame.view->knobs);
    graph::Pass pass = graph.add(passOf(range.shadow));
    counters = pass.write(counters, Use::StorageWrite);
    const AreaLit mean{pass.write(diffuse.now, Use::StorageWrite),
                       frame.isGlossy ? pass.write(specular.now, Use::StorageWrite) : graph::ImageRef{}};
    const AreaLit before = referenceFrames_ > 0 ? AreaLit{diffuse.before, specular.before} : AreaLit{};
    declareShade(pass, frame, range, before, mean, counters, isDone ? 0 : kSamplesAFrame, referenceFrames_, 1);
    referenceFrames_ += isDone ? 0 : 1;
    return mean;
}

AreaLit AreaLightSystem::declareLights(graph::FrameGraph& graph, const Frame& frame, const AreaLightRange& range, const AreaLit& before,
                                       graph::BufferRef& counters)
{
    graph::Pass pass = graph.add(passOf(range.shadow));
    counters = pass.write(counters, Use::StorageWrite);
    const auto scale = static_cast<uint32_t>(frame.scale);
    const graph::ImageDesc desc{.format = kLitFormat, .like = frame.g->depth, .scale = 1.0f / static_cast<float>(scale)};
    const AreaLit made{pass.create("area diffuse", desc, Use::StorageWrite),
                       frame.isGlossy ? pass.create("area specular", desc, Use::StorageWrite) : graph::ImageRef{}};
    declareShade(pass, frame, range, before, made, counters, frame.view->knobs.area.rays, 0, scale);
    return made;
}

AreaLit AreaLightSystem::declareUpsample(graph::FrameGraph& graph, const Frame& frame, const AreaLit& lit)
{
    gpu::Pipeline& pipeline = upsample_[frame.isGlossy ? 1 : 0];
    constexpr gpu::ShaderDefine glossy{"GLOSSY"};
    if (!pipeline)
        pipeline = computePipeline(*device_, "area_upsample.comp", std::span(&glossy, frame.isGlossy ? 1 : 0));
    graph::Pass pass = graph.add("area upsample");
    for (const graph::ImageRef image : {frame.g->depth, frame.g->normals, lit.diffuse, lit.specular})
        if (image)
            pass.read(image, Use::Sampled);
    const graph::ImageDesc desc{.format = kLitFormat, .like = frame.g->depth};
    const AreaLit made{pass.create("area diffuse, upsampled", desc, Use::StorageWrite),
                       frame.isGlossy ? pass.create("area specular, upsampled", desc, Use::StorageWrite) : graph::ImageRef{}};
    pass.record(
        [&pipeline, slot = frame.slot, g = *frame.g, lit, made, scale = static_cast<uint32_t>(frame.scale)](graph::Recorder& recorder) {
            recorder.dispatch(pipeline,
                              shader::AreaUpsample{.frame = slot,
                                                   .depth = recorder.sampled(g.depth),
                                                   .normals = recorder.sampled(g.normals),
                                                   .diffuseLit = recorder.sampled(lit.diffuse),
                                                   .specularLit = lit.specular ? recorder.sampled(lit.specular) : 0,
                                                   .diffuse = recorder.storage(made.diffuse),
                                                   .specular = made.specular ? recorder.storage(made.specular) : 0,
                                                   .pixelScale = static_cast<int>(scale)},
                              recorder.extent(g.depth) / scale + 2u);
        });
    return made;
}

void AreaLightSystem::skipAll(graph::FrameGraph& graph)
{
    for (const std::string_view pass :
         {"area tiles", "area analytic", "area triangles", "area unshadowed", "area traced", "area reference", "area upsample"})
        graph.skip(pass, "no AreaLight in the scene");
    FieldShadowSystem::skip(graph, "no AreaLight in the scene");
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
    const uvec2 tileCount = (graph.extent(g.depth) + shader::kAreaTileSize - 1u) / shader::kAreaTileSize;
    Frame frame{.view = &view,
                .scene = &scene,
                .g = &g,
                .posed = &posed,
                .area = bodies_.write(view, tileCount.x),
                .tiles = {},
                .seenPastFields = {},
                .slot = slot,
                .scale = view.hasReferenceLights() ? Scale::Full : view.knobs.area.scale,
                .isGlossy = static_cast<bool>(g.material)};
    prepareTables(frame.isGlossy);
    const auto scale = static_cast<uint32_t>(frame.scale);
    const LitPixels pixels{.extent = (graph.extent(g.depth) + scale - 1u) / scale, .scale = scale};
    frame.seenPastFields = fieldShadows_.declare(graph, view, slot, fields, g, frame.area, bodies_.lightCount(), pixels, counters);
    if (view.probedPixel)
        probe_.declare(graph, slot, g, frame.area, *view.probedPixel, view.knobs.area.planes);
    AreaLit lit;
    for (const AreaLightRange& range : bodies_.ranges()) {
        if (!frame.tiles && (range.shadow == LightShadow::Analytic || range.shadow == LightShadow::Triangles))
            frame.tiles = declareTiles(graph, frame, tileCount);
        hasReference_ = hasReference_ || range.shadow == LightShadow::Reference;
        lit = range.shadow == LightShadow::Reference ? declareReference(graph, frame, range, counters)
                                                     : declareLights(graph, frame, range, lit, counters);
    }
    if (frame.scale != Scale::Full)
        return declareUpsample(graph, frame, lit);
    graph.skip("area upsample", "area light is found for every pixel");
    return lit;
}

} // namespace antumbra::render
