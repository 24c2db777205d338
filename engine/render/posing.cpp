#include "render/posing.h"

#include "render/frame_copy.h"
#include "render/shader_structs.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace antumbra::render {

namespace {

using graph::Use;

constexpr std::string_view kNoCharacters = "no DynamicSkinned in the scene";

float greatestScale(const mat4& matrix)
{
    // The Frobenius norm bounds the spectral norm, exactly so for a uniform scale once divided by sqrt(3); columns are safe for shears too.
    const mat3 linear(matrix);
    const float columns = std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
    const bool isOrthogonal =
        std::abs(glm::dot(linear[0], linear[1])) + std::abs(glm::dot(linear[1], linear[2])) + std::abs(glm::dot(linear[2], linear[0])) <
        1e-5f * columns * columns;
    return isOrthogonal ? columns
                        : std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) + glm::dot(linear[2], linear[2]));
}

} // namespace

void PosingSystem::makePipelines(const FrameView& view, RayBackend backend)
{
    if (view.tracesRays() && backend == RayBackend::ComputeBvh && !bvhRefit_) {
        bvhRefit_ = computePipeline(*device_, "bvh_refit.comp");
        bvhScene_ = computePipeline(*device_, "bvh_scene.comp");
    }
    if (view.characters.empty() || skinning_)
        return;
    skinning_ = computePipeline(*device_, "skinning.comp");
    boneFit_ = computePipeline(*device_, "bone_fit.comp");
    sphereFit_ = computePipeline(*device_, "sphere_fit.comp");
    blockers_ = computePipeline(*device_, "blockers.comp");
}

void PosingSystem::choose(const FrameView& view, GpuScene& scene)
{
    chosen_.clear();
    for (uint32_t i = 0; i < view.characters.size(); ++i) {
        const CharacterDraw& draw = view.characters[i];
        const DeviceCharacter& character = scene.character(draw.slot);
        if (!character.isPosed || character.poseVersion != draw.poseVersion)
            chosen_.push_back(i);
    }
    // First those that have never been posed, then whoever waits longest.
    const auto age = [&](uint32_t i) {
        const DeviceCharacter& character = scene.character(view.characters[i].slot);
        return std::pair(character.isPosed ? character.posedInFrame : 0, i);
    };
    std::ranges::sort(chosen_, {}, age);
    const auto firstPosed =
        std::ranges::find_if(chosen_, [&](uint32_t i) { return scene.character(view.characters[i].slot).isPosed; }) - chosen_.begin();
    chosen_.resize(std::min(chosen_.size(), std::max<size_t>(view.knobs.occlusion.builds, static_cast<size_t>(firstPosed))));
    for (const uint32_t i : chosen_) {
        DeviceCharacter& character = scene.character(view.characters[i].slot);
        character.isPosed = true;
        character.poseVersion = view.characters[i].poseVersion;
        character.posedInFrame = device_->frameNumber();
    }
}

void PosingSystem::declareSkinning(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed)
{
    uint64_t bytes = 0;
    for (const CharacterDraw& draw : view.characters)
        bytes += scene.character(draw.slot).positions.bytes() + scene.character(draw.slot).normals.bytes();
    posed.vertices = graph.importBuffer("posed vertices", bytes);
    if (chosen_.empty()) {
        graph.skip("skinning", "no pose changed");
        return;
    }
    graph::Pass pass = graph.add("skinning");
    posed.vertices = pass.write(posed.vertices, Use::StorageWrite);
    pass.sideEffect(); // what it writes outlives the frame
    pass.record([this, &view, &scene](graph::Recorder& recorder) {
        for (const uint32_t i : chosen_) {
            const CharacterDraw& draw = view.characters[i];
            const DeviceSkin& skin = scene.skin(draw.model);
            const DeviceCharacter& character = scene.character(draw.slot);
            const uint32_t vertexCount = scene.model(draw.model).vertexCount;
            const VkDeviceAddress joints = frameCopy(*device_, std::span(view.joints).subspan(draw.firstJoint, skin.jointCount));
            const VkDeviceAddress weights =
                frameCopy(*device_, std::span(view.morphWeights).subspan(draw.firstMorphWeight, skin.morphCount));
            recorder.dispatch(skinning_,
                              shader::SkinningDispatch{skin.bindPositions.address(), skin.bindNormals.address(), skin.influences.address(),
                                                       joints, skin.morphs.address(), skin.morphOffsets.address(), weights,
                                                       character.positions.address(), character.normals.address(), vertexCount,
                                                       skin.morphCount},
                              {vertexCount, 1}, {64, 1});
        }
        recorder.orderWithinPass();
        for (const uint32_t i : chosen_) {
            const CharacterDraw& draw = view.characters[i];
            const DeviceSkin& skin = scene.skin(draw.model);
            const DeviceCharacter& character = scene.character(draw.slot);
            const VkDeviceAddress joints = frameCopy(*device_, std::span(view.joints).subspan(draw.firstJoint, skin.jointCount));
            recorder.dispatch(boneFit_,
                              shader::BoneFitDispatch{character.positions.address(), joints, skin.bones.address(),
                                                      skin.boneVertices.address(), character.capsules.address()},
                              {skin.boneCount, 1}, {1, 1});
        }
        recorder.orderWithinPass();
        for (const uint32_t i : chosen_) {
            const CharacterDraw& draw = view.characters[i];
            const DeviceCharacter& character = scene.character(draw.slot);
            recorder.dispatch(sphereFit_,
                              shader::SphereFitDispatch{character.positions.address(), character.capsules.address(),
                                                        character.sphere.address(), scene.model(draw.model).vertexCount,
                                                        scene.skin(draw.model).boneCount},
                              {1, 1}, {1, 1});
        }
    });
}

void PosingSystem::declareBounds(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed)
{
    graph::Pass pass = graph.add("bounds");
    pass.read(posed.vertices, Use::StorageRead);
    posed.bounds = pass.write(graph.importBuffer("bounds", scene.capsules().bytes()), Use::StorageWrite);
    pass.record([this, &view, &scene](graph::Recorder& recorder) {
        const auto count = static_cast<uint32_t>(view.characters.size());
        const gpu::FrameBytes bytes = device_->frameBytes(count * sizeof(shader::BlockerSource));
        uint32_t firstCapsule = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const CharacterDraw& draw = view.characters[i];
            const DeviceCharacter& character = scene.character(draw.slot);
            const uint32_t capsuleCount = scene.skin(draw.model).boneCount;
            const shader::BlockerSource source{
                draw.world, character.sphere.address(), character.capsules.address(), firstCapsule, capsuleCount, greatestScale(draw.world),
                0};
            std::memcpy(bytes.mapped + i * sizeof(source), &source, sizeof(source));
            firstCapsule += capsuleCount;
        }
        recorder.dispatch(blockers_, shader::BlockerDispatch{bytes.address, scene.blockers().address(), scene.capsules().address()},
                          {count, 1}, {1, 1});
    });
}

Posed PosingSystem::declare(graph::FrameGraph& graph, const FrameView& view, GpuScene& scene, const FieldFrame& fields)
{
    Posed posed;
    const bool hasCharacters = !view.characters.empty();
    makePipelines(view, scene.backend());
    choose(view, scene);
    if (hasCharacters)
        declareSkinning(graph, view, scene, posed);
    else
        graph.skip("skinning", kNoCharacters);
    if (view.tracesRays()) {
        declareTriangleBuilds(graph, view, scene, posed);
        declareBoxBuilds(graph, scene, fields, posed);
        declareSceneBuild(graph, view, scene, posed);
    } else {
        fieldBoxes_.drop();
        for (const std::string_view pass : {"triangle builds", "box builds", "scene build"})
            graph.skip(pass, hasCharacters ? "no light is shadowed by rays" : kNoCharacters);
    }
    if (hasCharacters && view.hasEnvironment())
        declareBounds(graph, view, scene, posed);
    else
        graph.skip("bounds", hasCharacters ? "no Environment in the scene" : kNoCharacters);
    return posed;
}

} // namespace antumbra::render
