#include "truth/shown.h"

#include <cmath>

namespace antumbra::truth {

Shown::Shown(gpu::Device& device, const scene::SceneFile& scene, uvec2 extent, float seconds, app::Gameplay gameplay)
    : stage_(scene, 0, gameplay), renderer_(device, stage_.assets(), extent)
{
    view_.knobs.occlusion = {
        .culling = render::Culling::Length, .samples = 128, .scale = render::Scale::Full, .filter = 0, .tolerance = 0, .builds = 1000};
    advance(seconds);
}

void Shown::advance(float seconds)
{
    stage_.advanceClips(seconds);
    stage_.extract(view_);
}

void Shown::draw(uint32_t frames)
{
    for (uint32_t frame = 0; frame < frames; ++frame)
        renderer_.render(view_);
}

scene::ImageF Shown::capture(render::Aov aov)
{
    renderer_.capture(std::span(&aov, 1));
    draw();
    return renderer_.captured(aov);
}

scene::ImageF Shown::reference(uint32_t samples)
{
    const render::ReferenceKnobs before = view_.knobs.reference;
    view_.knobs.reference.samples = samples;
    do
        draw();
    while (renderer_.referenceSamples().value_or(samples) < samples);
    scene::ImageF mean = capture(render::Aov::Occluded);
    view_.knobs.reference = before;
    return mean;
}

shader::CounterBlock Shown::counters()
{
    draw(1 + gpu::kFramesInFlight); // reported once the device is done
    return renderer_.report().counters;
}

std::string backendName(const testing::TestParamInfo<Backend>& test)
{
    return test.param.backend == render::RayBackend::RayQuery ? "RayQuery" : "ComputeBvh";
}

vec3 positionAt(const render::CameraView& camera, uvec2 extent, uvec2 pixel, float depthView)
{
    const vec2 size(extent);
    const vec2 share = (vec2(pixel) + 0.5f) / size * 2.0f - 1.0f;
    const float tangent = std::tan(0.5f * camera.verticalFovRadians);
    const vec3 ray(share.x * tangent * size.x / size.y, -share.y * tangent, -1);
    return camera.eye + camera.rotation * (ray * depthView);
}

std::vector<std::string> stepsOf(Shown& shown)
{
    std::vector<std::string> names;
    for (const graph::Step& step : shown.renderer().plan().steps)
        names.emplace_back(shown.renderer().frameGraph().passes()[step.pass].name);
    return names;
}

uint64_t settledBytes(gpu::Device& device)
{
    for (uint32_t frame = 0; frame < 2 * gpu::kFramesInFlight; ++frame) {
        device.beginFrame();
        device.endFrame(VK_NULL_HANDLE, VK_NULL_HANDLE);
    }
    return device.memory().stats().usedBytes;
}

std::vector<size_t> surfaceOf(const scene::ImageF& depth)
{
    std::vector<size_t> pixels;
    for (size_t pixel = 0; pixel < depth.values.size(); ++pixel)
        if (depth.values[pixel] > 0)
            pixels.push_back(pixel);
    return pixels;
}

std::vector<size_t> pixelsAtHeight(Shown& shown, float height)
{
    const scene::ImageF depth = shown.capture(render::Aov::Depth);
    std::vector<size_t> pixels = surfaceOf(depth);
    std::erase_if(pixels, [&](size_t pixel) {
        const vec3 position =
            positionAt(shown.view().camera, Shown::kExtent, {pixel % Shown::kExtent.x, pixel / Shown::kExtent.x}, depth.values[pixel]);
        return std::abs(position.y - height) > 1e-3f;
    });
    return pixels;
}

vec3 pixelOf(const scene::ImageF& image, size_t pixel)
{
    const float* rgb = &image.values[3 * pixel];
    return {rgb[0], rgb[1], rgb[2]};
}

double meanOf(const scene::ImageF& image, const std::vector<size_t>& pixels)
{
    double sum = 0;
    for (const size_t pixel : pixels)
        sum += glm::dot(pixelOf(image, pixel), vec3(1.0f / 3));
    return sum / static_cast<double>(pixels.size());
}

double rmse(const scene::ImageF& a, const scene::ImageF& b, const std::vector<size_t>& pixels)
{
    double squares = 0;
    for (const size_t pixel : pixels) {
        const vec3 difference = pixelOf(a, pixel) - pixelOf(b, pixel);
        squares += double{glm::dot(difference, difference)};
    }
    return std::sqrt(squares / static_cast<double>(3 * pixels.size()));
}

scene::SceneFile namedScene(const std::string& name, const scene::Settings& overrides) { return app::findScene(name, overrides); }

scene::SceneFile emptyScene()
{
    scene::SceneFile scene;
    scene.camera = {.position = {0, 3, 4}, .target = {0, 0.3f, 0}, .verticalFovRadians = glm::radians(40.0f)};
    scene.environment = scene::SceneEnvironment{};
    return scene;
}

scene::SceneEntity staticShape(scene::MeshKind kind, vec3 position, vec3 scale)
{
    scene::SceneEntity shape{.mesh = {kind, {}}, .isStaticPRT = true};
    shape.transform.position = position;
    shape.transform.scale = scale;
    return shape;
}

scene::SceneEntity movingShape(scene::MeshKind kind, vec3 position, vec3 scale)
{
    scene::SceneEntity shape = staticShape(kind, position, scale);
    shape.isStaticPRT = false;
    shape.isDynamicSkinned = true;
    return shape;
}

scene::SceneEntity fieldBall(vec3 position, float radius)
{
    scene::SceneEntity entity;
    entity.transform.position = position;
    entity.sdfPrimitive = scene::SDFPrimitive{.shape = scene::SDFShape::Sphere, .radius = radius};
    return entity;
}

scene::SceneEntity walker(vec3 position, const std::string& clip)
{
    scene::SceneEntity character{.mesh = {scene::MeshKind::File, projectPath("assets") / "characters/walker.glb"}};
    character.transform.position = position;
    character.animation = scene::SceneAnimation{.clip = clip};
    character.isDynamicSkinned = true;
    return character;
}

scene::SceneFile darkScene()
{
    scene::SceneFile scene = emptyScene();
    scene.environment.reset();
    scene.entities = {staticShape(scene::MeshKind::Plane, {0, 0, 0}, {4, 1, 4})};
    return scene;
}

scene::SceneEntity lampAt(vec3 position, vec3 radiance)
{
    scene::SceneEntity lamp;
    lamp.transform.position = position;
    lamp.transform.rotation = glm::angleAxis(kPi, vec3(1, 0, 0)); // shines down
    lamp.areaLight = scene::AreaLight{.size = vec2(0.4f), .radiance = radiance};
    return lamp;
}

scene::SceneEntity blocker(vec3 position, vec3 scale)
{
    scene::SceneEntity block = staticShape(scene::MeshKind::Cube, position, scale);
    block.occluder.emplace();
    return block;
}

} // namespace antumbra::truth
