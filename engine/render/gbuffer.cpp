#include "render/gbuffer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace antumbra::render {

namespace {

using graph::Faces;
using graph::Use;

constexpr gpu::Format kNormalFormat = gpu::Format::Rgba16Snorm;
constexpr gpu::Format kAlbedoFormat = gpu::Format::Rgba8Srgb;
constexpr gpu::Format kIrradianceFormat = gpu::Format::Rgba16Float;
constexpr gpu::Format kMaterialFormat = gpu::Format::Rgba8Unorm;
constexpr gpu::Format kStepsFormat = gpu::Format::Rgba16Float;

gpu::Pipeline makePipeline(gpu::Device& device, std::span<const gpu::ShaderDefine> defines, bool keepsMaterial)
{
    constexpr std::array all{kNormalFormat, kAlbedoFormat, kIrradianceFormat, kMaterialFormat};
    const std::span formats = std::span(all).first(keepsMaterial ? 4 : 3);
    return rasterPipeline(device, {.vertexShader = "gbuffer.vert",
                                   .fragmentShader = "gbuffer.frag",
                                   .defines = defines,
                                   .colorFormats = formats,
                                   .depthFormat = gpu::Format::Depth32Float});
}

/// Never NaN, which a world of huge numbers can lead to and no order knows.
float sortable(float depthView) { return std::fmax(depthView, 0.0f); }

Faces facesOf(const DeviceMaterial& material, const mat4& world)
{
    const bool isMirrored = glm::determinant(mat3(world)) < 0.0f;
    return material.isTwoSided ? Faces::Both : isMirrored ? Faces::FrontMirrored : Faces::Front;
}

} // namespace

GBufferSystem::FirstTerm GBufferSystem::firstTermOf(const FrameView& view, uint32_t object)
{
    if (!view.hasEnvironment())
        return FirstTerm::None;
    if (view.shownBake() == nullptr)
        return FirstTerm::Environment;
    return object < view.statics.size() && view.statics[object].isBaked ? FirstTerm::Atlas : FirstTerm::Volume;
}

void GBufferSystem::makePipelines(FirstTerm firstTerm)
{
    MaterialPipelines& made = pipelinesOf(firstTerm);
    if (made.plain)
        return;
    std::vector<gpu::ShaderDefine> defines;
    if (firstTerm != FirstTerm::Environment)
        defines.push_back({firstTerm == FirstTerm::Atlas ? "BAKED" : firstTerm == FirstTerm::Volume ? "LOCAL_LIGHT" : "DARK"});
    if (keepsMaterial_)
        defines.push_back({"KEEPS_MATERIAL"});
    made.plain = makePipeline(*device_, defines, keepsMaterial_);
    defines.push_back({"TEXTURED"});
    made.textured = makePipeline(*device_, defines, keepsMaterial_);
    defines.push_back({"CUT_OUT"});
    made.cutOut = makePipeline(*device_, defines, keepsMaterial_);
}

const gpu::Pipeline& GBufferSystem::pipelineFor(FirstTerm firstTerm, const shader::MaterialBlock& material)
{
    const auto& [plain, textured, cutOut] = pipelinesOf(firstTerm);
    return material.alphaCutoff > 0.0f ? cutOut : material.albedoImage != shader::kNoImage ? textured : plain;
}

// Nearest first, so that few pixels are shaded twice. What ends behind comes last: a floor or a wall reaches near and lies behind most of
// what is on it.
void GBufferSystem::listDraws(const FrameView& view, const GpuScene& scene, uvec2 extent)
{
    draws_.clear();
    const mat4 clipFromWorld = render::clipFromWorld(view.camera, extent);
    size_t most = 0;
    uint32_t object = 0;
    for (const StaticDraw& each : view.statics) {
        const std::vector<Cluster>& clusters = scene.model(each.model).clusters;
        const mat4 clipFromLocal = clipFromWorld * each.world;
        for (uint32_t cluster = 0; cluster < clusters.size(); ++cluster)
            if (const std::optional<float> depthView = farthestSeen(clusters[cluster].box, clipFromLocal))
                draws_.push_back({sortable(*depthView), object, cluster});
        most += clusters.size();
        ++object;
    }
    for (const CharacterDraw& each : view.characters) {
        const std::vector<Cluster>& clusters = scene.model(each.model).clusters;
        const float depthView = sortable((clipFromWorld * each.world[3]).w);
        for (uint32_t cluster = 0; cluster < clusters.size(); ++cluster)
            draws_.push_back({depthView, object, cluster});
        most += clusters.size();
        ++object;
    }
    draws_.reserve(most);
    std::ranges::sort(draws_, {}, &Draw::place);
}

void GBufferSystem::prepareFields(const FrameView& view, bool keepsSteps)
{
    FieldShader shader{
        .file = "field.frag", .colorFormats = {kNormalFormat, kAlbedoFormat, kIrradianceFormat}, .depthFormat = gpu::Format::Depth32Float};
    if (!view.hasEnvironment())
        shader.define("DARK");
    else if (view.shownBake() != nullptr)
        shader.define("LOCAL_LIGHT");
    if (keepsMaterial_) {
        shader.define("KEEPS_MATERIAL");
        shader.addColor(kMaterialFormat);
    }
    if (keepsSteps) {
        shader.define("KEEPS_STEPS");
        shader.addColor(kStepsFormat);
    }
    fields_.prepare(shader);
}

bool GBufferSystem::isGlossy(const FrameView& view, const GpuScene& scene)
{
    const auto reflects = [&](const auto& draw) {
        return std::ranges::any_of(scene.model(draw.model).materials, [](const DeviceMaterial& material) {
            return material.block.specular > 0 || material.block.metallic > 0;
        });
    };
    const auto fieldReflects = [](const FieldStepDraw& draw) { return draw.surface.specular > 0 || draw.surface.metallic > 0; };
    return !view.areaLights.empty() && (std::ranges::any_of(view.statics, reflects) || std::ranges::any_of(view.characters, reflects) ||
                                        std::ranges::any_of(view.fieldSteps, fieldReflects));
}

GBuffer GBufferSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene,
                               const FieldFrame& fields, const Baked& baked, const Posed& posed, uvec2 extent, Kept kept)
{
    keepsMaterial_ = isGlossy(view, scene);
    if (baked) {
        makePipelines(FirstTerm::Atlas);
        makePipelines(FirstTerm::Volume);
    } else {
        makePipelines(view.hasEnvironment() ? FirstTerm::Environment : FirstTerm::None);
    }
    listDraws(view, scene, extent);
    graph::Pass pass = graph.add("g-buffer");
    if (posed.vertices)
        pass.read(posed.vertices, Use::VertexRead);
    if (baked) {
        pass.read(baked.texels, Use::StorageRead);
        pass.read(baked.cells, Use::StorageRead);
    }
    GBuffer g;
    g.depth = pass.create("depth", {.format = gpu::Format::Depth32Float, .extent = extent, .clear = vec4{0}}, Use::DepthAttachment);
    // Passes ask the depth first, so that only who looks at the images themselves needs something where nothing is.
    const std::optional<vec4> blank = kept.all ? std::optional(vec4{0}) : std::nullopt;
    const auto create = [&](std::string_view name, gpu::Format format) {
        return pass.create(name, {.format = format, .extent = extent, .clear = blank}, Use::ColorAttachment);
    };
    g.normals = create("normals", kNormalFormat);
    g.albedo = create("albedo", kAlbedoFormat);
    g.unshadowed = create("unshadowed", kIrradianceFormat);
    if (keepsMaterial_)
        g.material = create("material", kMaterialFormat);
    const bool keepsSteps = kept.steps && fields;
    if (keepsSteps)
        g.steps = create("steps", kStepsFormat);
    if (fields)
        prepareFields(view, keepsSteps);

    pass.record([this, &view, &scene, frame, hasFields = static_cast<bool>(fields), extent](graph::Recorder& recorder) {
        if (hasFields) // first: what they hide is not shaded
            fields_.draw(recorder, view, frame, extent);
        const auto draw = [&](const Draw& each, const DeviceModel& model, const mat4& world, const gpu::Buffer& positions,
                              const gpu::Buffer& normals, uint32_t flags) {
            const Cluster& triangles = model.clusters[each.cluster];
            const DeviceMaterial& material = model.materials[triangles.material];
            const mat4 rows = glm::transpose(world);
            recorder.drawIndexed(pipelineFor(firstTermOf(view, each.object), material.block),
                                 shader::GBufferDraw{.worldFromLocal = {rows[0], rows[1], rows[2]},
                                                     .material = material.block,
                                                     .positions = positions.address(),
                                                     .normals = normals.address(),
                                                     .uvs = model.uvs.address(),
                                                     .bakeUvs = model.bakeUvs.address(),
                                                     .frame = frame,
                                                     .flags = flags},
                                 model.clusterIndices, triangles.indexCount, facesOf(material, world), triangles.firstIndex);
        };
        for (const Draw& each : draws_)
            if (each.object < view.statics.size()) {
                const StaticDraw& object = view.statics[each.object];
                const DeviceRest& rest = scene.rest(object.model);
                draw(each, scene.model(object.model), object.world, rest.positions, rest.normals, 0);
            } else {
                const CharacterDraw& object = view.characters[each.object - view.statics.size()];
                const DeviceCharacter& character = scene.character(object.slot);
                draw(each, scene.model(object.model), object.world, character.positions, character.normals, shader::kDrawDynamic);
            }
    });
    return g;
}

} // namespace antumbra::render
