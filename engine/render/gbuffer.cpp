#include "render/gbuffer.h"

#include <array>

namespace antumbra::render {

namespace {

using graph::Use;

constexpr gpu::Format kNormalFormat = gpu::Format::Rgba16Snorm;
constexpr gpu::Format kAlbedoFormat = gpu::Format::Rgba8Srgb;
constexpr gpu::Format kIrradianceFormat = gpu::Format::Rgba16Float;

void drawInstance(graph::Recorder& recorder, const gpu::Pipeline& pipeline, const DeviceModel& model, const mat4& world,
                  const shader::GBufferDraw& push)
{
    const bool isMirrored = glm::determinant(mat3(world)) < 0.0f;
    const graph::Faces faces = model.isTwoSided ? graph::Faces::Both : isMirrored ? graph::Faces::FrontMirrored : graph::Faces::Front;
    recorder.drawIndexed(pipeline, push, model.indices, 3 * model.triangleCount, faces);
}

} // namespace

GBufferSystem::GBufferSystem(gpu::Device& device)
{
    constexpr std::array formats{kNormalFormat, kAlbedoFormat, kIrradianceFormat};
    pipeline_ = rasterPipeline(device, {.vertexShader = "gbuffer.vert",
                                        .fragmentShader = "gbuffer.frag",
                                        .colorFormats = formats,
                                        .depthFormat = gpu::Format::Depth32Float});
}

GBuffer GBufferSystem::declare(graph::FrameGraph& graph, const FrameView& view, const FrameAddresses& addresses, const GpuScene& scene,
                               const Posed& posed, uvec2 extent) const
{
    graph::Pass pass = graph.add("g-buffer");
    if (posed.vertices)
        pass.read(posed.vertices, Use::VertexRead);
    GBuffer g;
    g.depth = pass.create("depth", {.format = gpu::Format::Depth32Float, .extent = extent, .clear = vec4{0}}, Use::DepthAttachment);
    g.normals = pass.create("normals", {.format = kNormalFormat, .extent = extent, .clear = vec4{0}}, Use::ColorAttachment);
    g.albedo = pass.create("albedo", {.format = kAlbedoFormat, .extent = extent, .clear = vec4{0}}, Use::ColorAttachment);
    g.unshadowed = pass.create("unshadowed", {.format = kIrradianceFormat, .extent = extent, .clear = vec4{0}}, Use::ColorAttachment);

    pass.record([this, &view, &scene, addresses](graph::Recorder& recorder) {
        shader::GBufferDraw push{addresses.instances, addresses.frame};
        for (const StaticDraw& draw : view.statics) {
            drawInstance(recorder, pipeline_, scene.model(draw.model), draw.world, push);
            push.instance += sizeof(shader::InstanceBlock);
        }
        for (const CharacterDraw& draw : view.characters) {
            drawInstance(recorder, pipeline_, scene.model(draw.model), draw.world, push);
            push.instance += sizeof(shader::InstanceBlock);
        }
    });
    return g;
}

} // namespace antumbra::render
