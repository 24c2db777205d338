#include "render/gbuffer.h"

#include <array>

namespace antumbra::render {

namespace {

using graph::Faces;
using graph::Use;

constexpr gpu::Format kNormalFormat = gpu::Format::Rgba16Snorm;
constexpr gpu::Format kAlbedoFormat = gpu::Format::Rgba8Srgb;
constexpr gpu::Format kIrradianceFormat = gpu::Format::Rgba16Float;

gpu::Pipeline makePipeline(gpu::Device& device, std::span<const gpu::ShaderDefine> defines)
{
    constexpr std::array formats{kNormalFormat, kAlbedoFormat, kIrradianceFormat};
    return rasterPipeline(device, {.vertexShader = "gbuffer.vert",
                                   .fragmentShader = "gbuffer.frag",
                                   .defines = defines,
                                   .colorFormats = formats,
                                   .depthFormat = gpu::Format::Depth32Float});
}

shader::GBufferDraw pushFor(const DeviceModel& model, const mat4& world, const gpu::Buffer& positions, const gpu::Buffer& normals)
{
    const mat4 rows = glm::transpose(world);
    return {.worldFromLocal = {rows[0], rows[1], rows[2]},
            .positions = positions.address(),
            .normals = normals.address(),
            .uvs = model.uvs.address(),
            .triangleMaterials = model.triangleMaterials.address(),
            .materials = model.materials.address()};
}

Faces facesOf(const DeviceModel& model, const mat4& world)
{
    const bool isMirrored = glm::determinant(mat3(world)) < 0.0f;
    return model.isTwoSided ? Faces::Both : isMirrored ? Faces::FrontMirrored : Faces::Front;
}

} // namespace

GBufferSystem::GBufferSystem(gpu::Device& device)
{
    constexpr gpu::ShaderDefine textured{"TEXTURED"};
    plain_ = makePipeline(device, {});
    textured_ = makePipeline(device, std::span(&textured, 1));
}

GBuffer GBufferSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const Posed& posed,
                               uvec2 extent) const
{
    graph::Pass pass = graph.add("g-buffer");
    if (posed.vertices)
        pass.read(posed.vertices, Use::VertexRead);
    GBuffer g;
    g.depth = pass.create("depth", {.format = gpu::Format::Depth32Float, .extent = extent, .clear = vec4{0}}, Use::DepthAttachment);
    g.normals = pass.create("normals", {.format = kNormalFormat, .extent = extent, .clear = vec4{0}}, Use::ColorAttachment);
    g.albedo = pass.create("albedo", {.format = kAlbedoFormat, .extent = extent, .clear = vec4{0}}, Use::ColorAttachment);
    g.unshadowed = pass.create("unshadowed", {.format = kIrradianceFormat, .extent = extent, .clear = vec4{0}}, Use::ColorAttachment);

    pass.record([this, &view, &scene, frame](graph::Recorder& recorder) {
        const auto draw = [&](const DeviceModel& model, const mat4& world, shader::GBufferDraw push, uint32_t flags) {
            push.frame = frame;
            push.flags = flags;
            recorder.drawIndexed(model.isTextured ? textured_ : plain_, push, model.indices, 3 * model.triangleCount,
                                 facesOf(model, world));
        };
        for (const StaticDraw& each : view.statics) {
            const DeviceModel& model = scene.model(each.model);
            const DeviceRest& rest = scene.rest(each.model);
            draw(model, each.world, pushFor(model, each.world, rest.positions, rest.normals), 0);
        }
        for (const CharacterDraw& each : view.characters) {
            const DeviceModel& model = scene.model(each.model);
            const DeviceCharacter& character = scene.character(each.slot);
            draw(model, each.world, pushFor(model, each.world, character.positions, character.normals), shader::kDrawDynamic);
        }
    });
    return g;
}

} // namespace antumbra::render
