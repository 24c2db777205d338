#include "render/composite.h"

#include <algorithm>
#include <functional>

namespace antumbra::render {

namespace {

using graph::ImageRef;
using graph::Use;

constexpr gpu::Format kPictureFormat = gpu::Format::Rgba8Unorm;
constexpr gpu::Format kKeptFormat = gpu::Format::Rgba16Float;

constexpr uvec2 kGroup{shader::kComposeGroupWidth, 1};

/// Of pixels between the same four squares (shaders/lib/upsample.glsl), of which those at the picture's edges are cut.
uvec2 blocksOf(uvec2 extent, uint32_t pixelScale) { return extent / pixelScale + 2u; }

uint32_t viewOf(ViewMode mode) { return static_cast<uint32_t>(mode); }
static_assert(static_cast<uint32_t>(ViewMode::Final) == shader::kViewFinal &&
              static_cast<uint32_t>(ViewMode::Reference) == shader::kViewReference);
static_assert(static_cast<uint32_t>(ViewMode::Difference) == shader::kViewDifference &&
              static_cast<uint32_t>(ViewMode::Cones) == shader::kViewCones);

/// What is drawn into the composed picture.
gpu::Pipeline drawnOver(gpu::Device& device, std::string_view vertexShader, std::string_view fragmentShader, bool keepsColor)
{
    constexpr std::array formats{kPictureFormat, kKeptFormat};
    constexpr gpu::ShaderDefine define{"KEEPS_COLOR"};
    return rasterPipeline(device, {.vertexShader = vertexShader,
                                   .fragmentShader = fragmentShader,
                                   .defines = std::span(&define, keepsColor ? 1 : 0),
                                   .colorFormats = std::span(formats).first(keepsColor ? 2 : 1),
                                   .depthFormat = gpu::Format::Depth32Float,
                                   .writesDepth = false});
}

/// Empty where area light is upsampled in a pass of its own.
std::string_view whyNotUpsampled(const Traced& traced, const AreaLit& found)
{
    if (!found.diffuse)
        return "no AreaLight in the scene";
    if (found.pixelScale == 1)
        return "area light is found for every pixel";
    return !traced.pixels || traced.pixelScale == found.pixelScale ? "composition does it" : "";
}

} // namespace

const gpu::Pipeline& CompositeSystem::composition(Variant variant)
{
    gpu::Pipeline& pipeline = compositions_[variant.index()];
    if (!pipeline) {
        const std::pair<bool, std::string_view> parts[] = {
            {variant.isOccluded, "OCCLUDED"},  {variant.explains, "EXPLAINS"},          {variant.isLit, "AREA_LIT"},
            {variant.isGlossy, "AREA_GLOSSY"}, {variant.isUpsampled, "AREA_UPSAMPLED"}, {variant.isDark, "DARK"}};
        std::vector<gpu::ShaderDefine> defines;
        for (const auto& [isPart, define] : parts)
            if (isPart)
                defines.push_back({define});
        pipeline = computePipeline(*device_, "composite.comp", defines);
    }
    return pipeline;
}

const gpu::Pipeline& CompositeSystem::sky(bool keepsColor)
{
    gpu::Pipeline& pipeline = skies_[keepsColor ? 1 : 0];
    if (!pipeline)
        pipeline = drawnOver(*device_, "sky.vert", "sky.frag", keepsColor);
    return pipeline;
}

const gpu::Pipeline& CompositeSystem::lightBody(bool keepsColor)
{
    gpu::Pipeline& pipeline = lightBodies_[keepsColor ? 1 : 0];
    if (!pipeline)
        pipeline = drawnOver(*device_, "light_body.vert", "light_body.frag", keepsColor);
    return pipeline;
}

AreaLit CompositeSystem::litWhereTraced(graph::FrameGraph& graph, uint32_t frame, const GBuffer& g, const Traced& traced,
                                        const AreaLit& found)
{
    if (const std::string_view reason = whyNotUpsampled(traced, found); !reason.empty()) {
        graph.skip("area upsample", reason);
        return found;
    }
    const bool isGlossy = static_cast<bool>(found.specular);
    gpu::Pipeline& pipeline = upsamples_[isGlossy ? 1 : 0];
    constexpr gpu::ShaderDefine glossy{"GLOSSY"};
    if (!pipeline)
        pipeline = computePipeline(*device_, "area_upsample.comp", std::span(&glossy, isGlossy ? 1 : 0));
    graph::Pass pass = graph.add("area upsample");
    for (const graph::ImageRef image : {g.depth, g.normals, found.diffuse, found.specular})
        if (image)
            pass.read(image, Use::Sampled);
    const graph::ImageDesc desc{.format = AreaLit::kFormat, .like = g.depth};
    const AreaLit made{pass.create("area diffuse, upsampled", desc, Use::StorageWrite),
                       isGlossy ? pass.create("area specular, upsampled", desc, Use::StorageWrite) : graph::ImageRef{}};
    pass.record([&pipeline, frame, g, found, made](graph::Recorder& recorder) {
        recorder.dispatch(pipeline,
                          shader::AreaUpsample{.frame = frame,
                                               .depth = recorder.sampled(g.depth),
                                               .normals = recorder.sampled(g.normals),
                                               .diffuseLit = recorder.sampled(found.diffuse),
                                               .specularLit = found.specular ? recorder.sampled(found.specular) : 0,
                                               .diffuse = recorder.storage(made.diffuse),
                                               .specular = made.specular ? recorder.storage(made.specular) : 0,
                                               .pixelScale = static_cast<int>(found.pixelScale)},
                          blocksOf(recorder.extent(g.depth), found.pixelScale), kGroup);
    });
    return made;
}

Composed CompositeSystem::declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const GBuffer& g,
                                  const Traced& traced, ImageRef reference, const AreaLit& found, ImageRef picture, Kept kept,
                                  graph::BufferRef& counters)
{
    const AreaLit lit = litWhereTraced(graph, frame, g, traced, found);
    const uint32_t scale = traced.pixels ? traced.pixelScale : lit.pixelScale;
    const bool explains = view.knobs.view != ViewMode::Final || kept.any() || reference;
    graph::Pass pass = graph.add("composite");
    for (const ImageRef image : {g.depth, g.normals, g.albedo, g.unshadowed, traced.pixels, reference, lit.diffuse, lit.specular})
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

    const gpu::Pipeline& pipeline = composition({.isOccluded = static_cast<bool>(traced.pixels),
                                                 .explains = explains,
                                                 .isLit = static_cast<bool>(lit.diffuse),
                                                 .isGlossy = static_cast<bool>(lit.specular),
                                                 .isUpsampled = lit.pixelScale > 1,
                                                 .isDark = !view.hasEnvironment()});
    pass.record([&pipeline, &view, frame, g, traced, reference, lit, composed, scale, counted = counters](graph::Recorder& recorder) {
        const auto sampled = [&](ImageRef image) { return image ? recorder.sampled(image) : shader::kAbsent; };
        const auto storage = [&](ImageRef image) { return image ? recorder.storage(image) : shader::kAbsent; };
        recorder.dispatch(pipeline,
                          shader::Composite{.counters = recorder.address(counted),
                                            .frame = frame,
                                            .depth = recorder.sampled(g.depth),
                                            .normals = recorder.sampled(g.normals),
                                            .albedo = recorder.sampled(g.albedo),
                                            .unshadowed = recorder.sampled(g.unshadowed),
                                            .traced = sampled(traced.pixels),
                                            .areaDiffuse = sampled(lit.diffuse),
                                            .areaSpecular = sampled(lit.specular),
                                            .pixelScale = static_cast<int>(scale),
                                            .reference = sampled(reference),
                                            .isReferenceShown = view.knobs.reference.samples > 0 && view.knobs.view == ViewMode::Final,
                                            .picture = recorder.storage(composed.picture),
                                            .exposure = view.exposure,
                                            .color = storage(composed.color),
                                            .irradiance = storage(composed.irradiance),
                                            .occluded = storage(composed.occluded),
                                            .view = viewOf(view.knobs.view),
                                            .splitX = view.splitColumn},
                          blocksOf(recorder.extent(composed.picture), scale), kGroup);
    });
    declareSky(graph, view, frame, g.depth, composed);
    declareLightBodies(graph, view, frame, scene, g.depth, composed);
    return composed;
}

// The G-buffer's depth stays what its surfaces are, so lights hide each other by their order.
void CompositeSystem::listLightBodies(const FrameView& view)
{
    farthestFirst_.clear();
    for (uint32_t i = 0; i < view.areaLights.size(); ++i)
        farthestFirst_.push_back({glm::distance(vec3(view.areaLights[i].world[3]), view.camera.eye), i});
    std::ranges::sort(farthestFirst_, std::greater{}, &LightBody::distance);
}

void CompositeSystem::declareLightBodies(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene,
                                         ImageRef depth, Composed& composed)
{
    if (view.areaLights.empty()) {
        graph.skip("light bodies", "no AreaLight in the scene");
        return;
    }
    listLightBodies(view);
    graph::Pass pass = graph.add("light bodies");
    pass.read(depth, Use::DepthRead);
    composed.picture = pass.write(composed.picture, Use::ColorAttachment);
    if (composed.color)
        composed.color = pass.write(composed.color, Use::ColorAttachment);
    pass.record([this, &drawn = lightBody(static_cast<bool>(composed.color)), &view, &scene, frame](graph::Recorder& recorder) {
        for (const LightBody& body : farthestFirst_) {
            const AreaLightDraw& light = view.areaLights[body.light];
            const DeviceModel& model = scene.model(light.model);
            const DeviceRest& rest = scene.rest(light.model);
            const mat4 rows = glm::transpose(light.world);
            recorder.drawIndexed(drawn,
                                 shader::LightBodyDraw{.worldFromLocal = {rows[0], rows[1], rows[2]},
                                                       .positions = rest.positions.address(),
                                                       .normals = rest.normals.address(),
                                                       .radiance = light.radiance,
                                                       .exposure = view.exposure,
                                                       .frame = frame,
                                                       .isTwoSided = light.isTwoSided ? 1u : 0u},
                                 model.indices, 3 * model.triangleCount, graph::Faces::Both);
        }
    });
}

void CompositeSystem::declareSky(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, ImageRef depth, Composed& composed)
{
    if (!view.hasEnvironment()) {
        graph.skip("sky", "no Environment in the scene");
        return;
    }
    graph::Pass pass = graph.add("sky");
    pass.read(depth, Use::DepthRead);
    composed.picture = pass.write(composed.picture, Use::ColorAttachment);
    if (composed.color)
        composed.color = pass.write(composed.color, Use::ColorAttachment);
    pass.record([&drawn = sky(static_cast<bool>(composed.color)), frame, exposure = view.exposure](graph::Recorder& recorder) {
        recorder.draw(drawn, shader::Sky{.frame = frame, .exposure = exposure}, 3);
    });
}

} // namespace antumbra::render
