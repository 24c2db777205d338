#include "render/gpu_scene.h"

#include "base/check.h"
#include "render/bones.h"
#include "scene/animation.h"
#include "scene/mean_albedo.h"

#include <algorithm>
#include <bit>

namespace antumbra::render {

namespace {

// Smaller ones leave out more and overlap less, yet cost a draw each; 256 to 1024 measure alike.
constexpr uint32_t kMostClusterTriangles = 512;

template <class T>
gpu::Buffer upload(gpu::Device& device, std::string_view label, const std::vector<T>& values)
{
    return gpu::uploadedBuffer(device, label, std::span<const T>(values));
}

gpu::Image uploadPicture(gpu::Device& device, const std::string& name, const scene::Image8& picture, bool isColor)
{
    const uvec2 extent{picture.width, picture.height};
    const auto levels = static_cast<uint32_t>(std::bit_width(std::max(extent.x, extent.y)));
    return gpu::uploadedImage(device, name,
                              {.format = isColor ? gpu::Format::Rgba8Srgb : gpu::Format::Rgba8Unorm, .extent = extent, .mipLevels = levels},
                              std::as_bytes(std::span(picture.rgba)));
}

gpu::Image uploadEnvironment(gpu::Device& device, const scene::ImageF& map)
{
    std::vector<float> rgba(size_t{4} * map.width * map.height, 1.0f);
    for (size_t i = 0; i < size_t{map.width} * map.height; ++i)
        std::copy_n(map.values.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
    return gpu::uploadedImage(device, "environment", {.format = gpu::Format::Rgba32Float, .extent = {map.width, map.height}},
                              std::as_bytes(std::span(rgba)));
}

std::vector<shader::InfluenceBlock> influencesOf(const scene::Mesh& mesh)
{
    std::vector<shader::InfluenceBlock> blocks;
    blocks.reserve(mesh.influences.size());
    for (const scene::Influence& influence : mesh.influences)
        blocks.push_back({influence.joints[0] | uint32_t{influence.joints[1]} << 16,
                          influence.joints[2] | uint32_t{influence.joints[3]} << 16,
                          {influence.weights[0], influence.weights[1], influence.weights[2], influence.weights[3]}});
    return blocks;
}

struct MorphStreams
{
    std::vector<shader::MorphBlock> blocks;
    std::vector<vec3> offsets;
};

MorphStreams morphsOf(const scene::Mesh& mesh)
{
    MorphStreams streams;
    for (const scene::MorphTarget& target : mesh.morphTargets) {
        shader::MorphBlock block{target.firstVertex, static_cast<uint32_t>(target.positions.size()),
                                 static_cast<uint32_t>(streams.offsets.size()), shader::kNoNormals};
        streams.offsets.insert(streams.offsets.end(), target.positions.begin(), target.positions.end());
        if (!target.normals.empty()) {
            block.normals = static_cast<uint32_t>(streams.offsets.size());
            streams.offsets.insert(streams.offsets.end(), target.normals.begin(), target.normals.end());
        }
        streams.blocks.push_back(block);
    }
    return streams;
}

template <class T>
std::optional<T>& slotOf(std::vector<std::optional<T>>& all, uint32_t index)
{
    if (all.size() <= index)
        all.resize(index + 1);
    return all[index];
}

} // namespace

GpuScene::GpuScene(gpu::Device& device, const scene::Assets& assets) : device_(&device), assets_(&assets) {}

void GpuScene::makeModel(uint32_t index)
{
    if (slotOf(models_, index))
        return;
    ++changes_;
    const scene::Model& model = assets_->models[index];
    DeviceModel made;
    made.vertexCount = static_cast<uint32_t>(model.mesh.positions.size());
    made.triangleCount = static_cast<uint32_t>(model.mesh.indices.size() / 3);
    made.indices = upload(*device_, "indices", model.mesh.indices);
    made.uvs = upload(*device_, "uvs", model.mesh.uvs);
    ClusteredTriangles clustered = clustersOf(model.mesh, restMesh(model).positions, kMostClusterTriangles);
    made.clusterIndices = upload(*device_, "cluster indices", clustered.indices);
    made.clusters = std::move(clustered.clusters);
    std::vector<uint32_t> slots;
    for (uint32_t i = 0; i < model.images.size(); ++i) {
        const bool isColor = std::ranges::any_of(model.materials, [&](const scene::Material& m) { return m.albedoImage == i; });
        made.images.push_back(uploadPicture(*device_, model.name, model.images[i], isColor));
        slots.push_back(made.images.back().sampledSlot());
    }
    const auto slot = [&](uint32_t image) { return image == scene::kNoIndex ? shader::kNoImage : slots[image]; };
    for (const scene::Material& m : model.materials)
        made.materials.push_back(
            {{m.albedo, m.alphaCutoff, m.alpha, m.roughness, m.metallic, m.specular, slot(m.albedoImage), slot(m.metallicRoughnessImage)},
             m.twoSided});
    made.meanAlbedo = scene::meanAlbedo(model);
    models_[index] = std::move(made);
}

void GpuScene::makeBakeUvs(uint32_t index)
{
    DeviceModel& model = *models_[index];
    if (model.bakeUvs)
        return;
    ++changes_;
    const scene::Mesh& mesh = assets_->models[index].mesh;
    check(mesh.bakeUvs.size() == mesh.positions.size(), "a place on the atlas for every vertex of what is baked");
    model.bakeUvs = upload(*device_, "bake uvs", mesh.bakeUvs);
}

void GpuScene::makeSkin(uint32_t index)
{
    if (slotOf(skins_, index))
        return;
    ++changes_;
    const scene::Model& model = assets_->models[index];
    const Bones bones = bonesOf(model);
    const MorphStreams morphs = morphsOf(model.mesh);
    DeviceSkin made;
    made.jointCount = static_cast<uint32_t>(model.joints.size());
    made.morphCount = static_cast<uint32_t>(morphs.blocks.size());
    made.boneCount = static_cast<uint32_t>(bones.blocks.size());
    made.bindPositions = upload(*device_, "bind positions", model.mesh.positions);
    made.bindNormals = upload(*device_, "bind normals", model.mesh.normals);
    made.influences = upload(*device_, "influences", influencesOf(model.mesh));
    made.morphs = upload(*device_, "morphs", morphs.blocks);
    made.morphOffsets = upload(*device_, "morph offsets", morphs.offsets);
    made.bones = upload(*device_, "bones", bones.blocks);
    made.boneVertices = upload(*device_, "bone vertices", bones.vertices);
    skins_[index] = std::move(made);
}

void GpuScene::makeRest(uint32_t index)
{
    if (slotOf(rests_, index))
        return;
    ++changes_;
    const scene::Mesh rest = restMesh(assets_->models[index]);
    rests_[index] = DeviceRest{upload(*device_, "rest positions", rest.positions), upload(*device_, "rest normals", rest.normals), {}};
}

void GpuScene::makeCharacter(uint32_t slot, uint32_t model)
{
    std::optional<DeviceCharacter>& character = slotOf(characters_, slot);
    if (character && character->model == model)
        return;
    ++changes_;
    const DeviceModel& streams = *models_[model];
    const DeviceSkin& skin = *skins_[model];
    DeviceCharacter made;
    made.model = model;
    const size_t vectorBytes = std::max<size_t>(streams.vertexCount, 1) * sizeof(vec3);
    made.positions = gpu::Buffer(*device_, "posed positions", vectorBytes);
    made.normals = gpu::Buffer(*device_, "posed normals", vectorBytes);
    made.capsules = gpu::Buffer(*device_, "posed capsules", std::max<size_t>(skin.boneCount, 1) * sizeof(shader::CapsuleBlock));
    made.sphere = gpu::Buffer(*device_, "posed sphere", sizeof(shader::SphereBlock));
    character = std::move(made);
}

void GpuScene::makeBounds(const FrameView& view)
{
    uint32_t capsules = 0;
    for (const CharacterDraw& draw : view.characters)
        capsules += skins_[draw.model]->boneCount;
    const auto blockers = static_cast<uint32_t>(view.characters.size());
    if (capsules <= capsuleCount_ && blockers <= blockerCount_)
        return;
    ++changes_;
    capsuleCount_ = std::max(capsules, capsuleCount_);
    blockerCount_ = std::max(blockers, blockerCount_);
    capsules_ = gpu::Buffer(*device_, "capsules", capsuleCount_ * sizeof(shader::CapsuleBlock));
    blockers_ = gpu::Buffer(*device_, "blockers", blockerCount_ * sizeof(shader::BlockerBlock));
}

void GpuScene::makeEnvironment(uint32_t index)
{
    std::optional<gpu::Image>& environment = slotOf(environments_, index);
    if (environment)
        return;
    ++changes_;
    environment = uploadEnvironment(*device_, assets_->environments[index]);
}

void GpuScene::dropCharacters(const FrameView& view)
{
    for (uint32_t slot = 0; slot < characters_.size(); ++slot)
        if (characters_[slot] && std::ranges::find(view.characters, slot, &CharacterDraw::slot) == view.characters.end()) {
            characters_[slot].reset();
            ++changes_;
        }
    if (!view.characters.empty() || blockerCount_ == 0)
        return;
    blockers_ = {};
    capsules_ = {};
    capsuleCount_ = blockerCount_ = 0;
}

void GpuScene::prepare(const FrameView& view)
{
    useBackend(backendFor(view.knobs.occlusion.backend, device_->info().rayQuery));
    for (const StaticDraw& draw : view.statics) {
        makeModel(draw.model);
        makeRest(draw.model);
        if (view.shownBake() != nullptr && draw.isBaked)
            makeBakeUvs(draw.model);
    }
    for (const CharacterDraw& draw : view.characters) {
        makeModel(draw.model);
        makeSkin(draw.model);
        makeCharacter(draw.slot, draw.model);
    }
    dropCharacters(view);
    for (const AreaLightDraw& light : view.areaLights) {
        makeModel(light.model);
        makeRest(light.model);
    }
    if (view.hasEnvironment())
        makeEnvironment(view.environment.image);
    if (view.tracesRays())
        makeTraced(view);
    else
        dropTraced();
    if (!view.characters.empty())
        makeBounds(view);
}

} // namespace antumbra::render
