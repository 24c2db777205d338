#include "render/frame_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace antumbra::render {

namespace {

mat4 reversedPerspective(float verticalFov, float aspect, float near)
{
    const float f = 1.0f / std::tan(0.5f * verticalFov);
    mat4 projection{0};
    projection[0][0] = f / aspect;
    projection[1][1] = -f;
    projection[2][3] = -1.0f;
    projection[3][2] = near;
    return projection;
}

void writeCamera(shader::FrameBlock& block, const CameraView& camera, uvec2 extent)
{
    const float width = static_cast<float>(extent.x), height = static_cast<float>(extent.y);
    block.clipFromWorld = clipFromWorld(camera, extent);
    block.eye = camera.eye;
    block.near = camera.nearMetres;
    const float top = std::tan(0.5f * camera.verticalFovRadians), right = top * width / height;
    block.cornerRay = camera.rotation * vec3{-right, top, -1.0f};
    block.rayX = camera.rotation * vec3{2.0f * right / width, 0, 0};
    block.rayY = camera.rotation * vec3{0, -2.0f * top / height, 0};
}

/// Of what hides light from frame to frame: characters, and all steps of distance fields for one more.
vec3 meanAlbedoOfBlockers(const FrameView& view, const GpuScene& scene)
{
    vec3 sum{0}, fields{0};
    for (const CharacterDraw& character : view.characters)
        sum += scene.model(character.model).meanAlbedo;
    for (const FieldStepDraw& step : view.fieldSteps)
        fields += step.surface.albedo / static_cast<float>(view.fieldSteps.size());
    const size_t count = view.characters.size() + (view.fieldSteps.empty() ? 0 : 1);
    return (sum + fields) / static_cast<float>(std::max<size_t>(count, 1));
}

/// What of baked light follows from the frame's own.
void completeBaked(shader::FrameBlock& block, const bake::BakeSettings& settings, vec3 albedo)
{
    for (uint32_t i = 0; i < shader::kLocalShCoefficients; ++i)
        block.baked.outside[i] = i < settings.coefficientCount() ? block.radianceSh[i] : vec3(0);
    constexpr float kFacesLight = 0.5f; // surfaces that face each other hide half of each other's light
    block.baked.sentOn = settings.bounces > 0 ? kFacesLight * albedo : vec3(0);
}

} // namespace

mat4 clipFromWorld(const CameraView& camera, uvec2 extent)
{
    const mat4 viewFromWorld = glm::mat4_cast(glm::conjugate(camera.rotation)) * glm::translate(mat4{1}, -camera.eye);
    const float aspect = static_cast<float>(extent.x) / static_cast<float>(extent.y);
    return reversedPerspective(camera.verticalFovRadians, aspect, camera.nearMetres) * viewFromWorld;
}

FrameBlocks::FrameBlocks(gpu::Device& device, const scene::Assets& assets) : device_(&device), assets_(&assets)
{
    for (gpu::Buffer& block : blocks_)
        block = gpu::Buffer(device, "frame block", sizeof(shader::FrameBlock), gpu::MemoryKind::Upload);
}

const bake::ShFunction& FrameBlocks::projected(uint32_t environment)
{
    if (projections_.size() <= environment)
        projections_.resize(environment + 1);
    if (!projections_[environment])
        projections_[environment] = bake::project(assets_->environments[environment], bake::kMostBands);
    return *projections_[environment];
}

void FrameBlocks::writeEnvironment(const FrameView& view, const GpuScene& scene)
{
    const EnvironmentView& environment = view.environment;
    shader::FrameBlock& block = newest_;
    if (!view.hasEnvironment()) {
        block.environmentIntensity = 0;
        std::ranges::fill(block.radianceSh, vec3(0));
        std::ranges::fill(block.irradianceSh, vec3(0));
        return;
    }
    bake::ShFunction radiance = bake::rotatedAboutY(projected(environment.image), environment.rotationRadians);
    if (view.shownBake() != nullptr)
        radiance = bake::windowed(radiance, view.knobs.prt.window);
    const bake::ShFunction irradiance = bake::irradianceOf(radiance);
    for (uint32_t i = 0; i < radiance.coefficientCount(); ++i) {
        block.radianceSh[i] = vec3(radiance.coefficients[i]) * environment.intensity;
        block.irradianceSh[i] = vec3(irradiance.coefficients[i]) * environment.intensity;
    }
    block.environment = scene.environment(environment.image).sampledSlot();
    block.environmentTurn = {std::cos(environment.rotationRadians), std::sin(environment.rotationRadians)};
    block.environmentIntensity = environment.intensity;
}

uint32_t FrameBlocks::write(const FrameView& view, const GpuScene& scene, const shader::BakedLight& baked, uvec2 extent)
{
    writeCamera(newest_, view.camera, extent);
    writeEnvironment(view, scene);
    newest_.baked = baked;
    if (const bake::Bake* bake = view.shownBake())
        completeBaked(newest_, bake->settings, meanAlbedoOfBlockers(view, scene));
    const gpu::Buffer& frame = blocks_[device_->frameSlot()];
    std::memcpy(frame.mapped(), &newest_, sizeof(newest_));
    return frame.slot();
}

} // namespace antumbra::render
