#include "render/gpu_scene.h"
#include "render/shadow/bvh.h"
#include "scene/animation.h"

#include <algorithm>

namespace antumbra::render {

void GpuScene::useBackend(RayBackend backend)
{
    if (backend == backend_)
        return;
    ++changes_;
    backend_ = backend;
    dropTraced();
}

void GpuScene::dropTraced()
{
    if (sceneInstances_ == 0)
        return;
    ++changes_;
    for (std::optional<DeviceCharacter>& character : characters_)
        if (character) {
            character->accel = {};
            character->scratch = {};
            character->nodes = {};
        }
    for (std::optional<DeviceRest>& rest : rests_)
        if (rest)
            rest->accel = {};
    for (std::optional<DeviceModel>& model : models_)
        if (model)
            model->nodes = {};
    scene_ = {};
    sceneScratch_ = {};
    bvhScene_ = {};
    sceneInstances_ = 0;
}

void GpuScene::makeTraced(const FrameView& view)
{
    for (const StaticDraw& draw : view.statics)
        usesBvh() ? makeNodes(draw.model) : buildRest(draw.model);
    for (const CharacterDraw& draw : view.characters) {
        if (usesBvh())
            makeNodes(draw.model);
        makeTracedCharacter(*characters_[draw.slot], *models_[draw.model]);
    }
    makeTracedScene(static_cast<uint32_t>(view.statics.size() + view.characters.size() + 1)); // distance fields are one
}

void GpuScene::makeTracedCharacter(DeviceCharacter& character, const DeviceModel& model)
{
    if (character.accel || character.nodes || model.triangleCount == 0)
        return;
    ++changes_;
    character.isPosed = false; // anew: only a changed pose is built or refitted
    if (usesBvh()) {
        character.nodes = gpu::Buffer(*device_, "posed nodes", 2 * size_t{bvhLeafCount(model.triangleCount)} * sizeof(shader::BvhNode));
    } else {
        const gpu::AccelSizes sizes = gpu::trianglesSizes(*device_, model.vertexCount, model.triangleCount, true);
        character.accel = gpu::Accel(*device_, "posed triangles", VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, sizes.structure);
        character.scratch = gpu::Buffer(*device_, "build scratch", sizes.scratch);
    }
}

void GpuScene::makeTracedScene(uint32_t instanceCount)
{
    if (instanceCount <= sceneInstances_)
        return;
    ++changes_;
    sceneInstances_ = instanceCount;
    if (usesBvh()) {
        bvhScene_ = gpu::Buffer(*device_, "scene", sizeof(shader::BvhScene) + instanceCount * sizeof(shader::BvhInstance));
        return;
    }
    const gpu::AccelSizes sizes = gpu::instancesSizes(*device_, instanceCount);
    scene_ = gpu::Accel(*device_, "scene", VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, sizes.structure);
    sceneScratch_ = gpu::Buffer(*device_, "build scratch", sizes.scratch);
}

void GpuScene::buildRest(uint32_t index)
{
    DeviceRest& rest = *rests_[index];
    const DeviceModel& model = *models_[index];
    if (rest.accel || model.triangleCount == 0)
        return;
    ++changes_;
    const gpu::AccelSizes sizes = gpu::trianglesSizes(*device_, model.vertexCount, model.triangleCount, false);
    rest.accel = gpu::Accel(*device_, "static triangles", VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, sizes.structure);
    const gpu::Buffer scratch(*device_, "build scratch", sizes.scratch);
    device_->submitNow([&](VkCommandBuffer commands) {
        gpu::recordBuild(commands, rest.accel, {rest.positions.address(), model.indices.address(), model.vertexCount, model.triangleCount},
                         false, scratch.address());
    });
}

void GpuScene::makeNodes(uint32_t index)
{
    DeviceModel& model = *models_[index];
    if (model.nodes)
        return;
    ++changes_;
    const scene::Mesh rest = restMesh(assets_->models[index]);
    const std::vector<shader::BvhNode> nodes = bvhOf(rest.positions, rest.indices);
    model.nodes = gpu::uploadedBuffer(*device_, "rest nodes", std::span<const shader::BvhNode>(nodes));
}

} // namespace antumbra::render
