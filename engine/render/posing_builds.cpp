#include "render/posing.h"
#include "render/shader_structs.h"
#include "render/shadow/bvh.h"

#include <algorithm>
#include <cstring>

namespace antumbra::render {

namespace {

using graph::Use;

shader::BvhPlacement placementOf(const mat4& world, const DeviceModel& model, const gpu::Buffer& nodes, const gpu::Buffer& positions,
                                 uint32_t mask)
{
    const mat4 rows = glm::transpose(glm::inverse(world));
    return {.worldFromLocal = world,
            .instance = {.localFromWorld = {rows[0], rows[1], rows[2]},
                         .nodes = nodes.address(),
                         .positions = positions.address(),
                         .indices = model.indices.address(),
                         .leafCount = bvhLeafCount(model.triangleCount),
                         .mask = mask}};
}

/// The frame's array of `T`, filled one by one; there is room for every object in view and all distance fields.
template <class T>
class FrameArray
{
public:
    FrameArray(gpu::Device& device, const FrameView& view)
        : bytes_(device.frameBytes((view.statics.size() + view.characters.size() + 1) * sizeof(T)))
    {
    }

    void append(const T& value) { std::memcpy(bytes_.mapped + count_++ * sizeof(T), &value, sizeof(T)); }
    [[nodiscard]] VkDeviceAddress address() const { return bytes_.address; }
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    gpu::FrameBytes bytes_;
    uint32_t count_ = 0;
};

void recordAccelBuilds(graph::Recorder& recorder, const FrameView& view, std::span<const uint32_t> chosen, const GpuScene& scene)
{
    for (const uint32_t i : chosen) {
        const CharacterDraw& draw = view.characters[i];
        const DeviceModel& model = scene.model(draw.model);
        const DeviceCharacter& character = scene.character(draw.slot);
        if (character.accel)
            gpu::recordBuild(recorder.commands(), character.accel,
                             {character.positions.address(), model.indices.address(), model.vertexCount, model.triangleCount}, true,
                             character.scratch.address());
    }
}

} // namespace

void PosingSystem::recordAccelScene(graph::Recorder& recorder, const FrameView& view, const GpuScene& scene) const
{
    FrameArray<VkAccelerationStructureInstanceKHR> instances(*device_, view);
    for (const StaticDraw& draw : view.statics)
        if (const gpu::Accel& accel = scene.rest(draw.model).accel)
            instances.append(gpu::instanceOf(draw.world, accel, shader::kMaskStatic));
    for (const CharacterDraw& draw : view.characters)
        if (const gpu::Accel& accel = scene.character(draw.slot).accel)
            instances.append(gpu::instanceOf(draw.world, accel, shader::kMaskDynamic));
    if (const gpu::Accel& accel = fieldBoxes_.accel())
        instances.append(gpu::instanceOf(mat4(1), accel, shader::kMaskFields));
    gpu::recordBuild(recorder.commands(), scene.scene(), instances.address(), instances.count(), scene.sceneScratch().address());
}

void PosingSystem::recordRefits(graph::Recorder& recorder, const FrameView& view, const GpuScene& scene) const
{
    for (const uint32_t i : chosen_) {
        const CharacterDraw& draw = view.characters[i];
        const DeviceModel& model = scene.model(draw.model);
        const DeviceCharacter& character = scene.character(draw.slot);
        recorder.dispatch(bvhRefit_,
                          shader::BvhRefitDispatch{model.nodes.address(), character.nodes.address(), character.positions.address(),
                                                   model.indices.address(), bvhLeafCount(model.triangleCount)},
                          {1, 1}, {1, 1});
    }
}

void PosingSystem::recordBvhScene(graph::Recorder& recorder, const FrameView& view, const GpuScene& scene) const
{
    FrameArray<shader::BvhPlacement> placements(*device_, view);
    // Of two hits at the same distance the first counts: characters come first, as for rays that ask for statics afterwards.
    for (const CharacterDraw& draw : view.characters) {
        const DeviceCharacter& character = scene.character(draw.slot);
        placements.append(placementOf(draw.world, scene.model(draw.model), character.nodes, character.positions, shader::kMaskDynamic));
    }
    for (const StaticDraw& draw : view.statics) {
        const DeviceModel& model = scene.model(draw.model);
        placements.append(placementOf(draw.world, model, model.nodes, scene.rest(draw.model).positions, shader::kMaskStatic));
    }
    const VkDeviceAddress header = scene.bvhScene().address();
    recorder.dispatch(bvhScene_,
                      shader::BvhSceneDispatch{placements.address(), header + sizeof(shader::BvhScene), header, placements.count()},
                      {std::max(placements.count(), 1u), 1}, {64, 1}); // of none too it writes the scene
}

void PosingSystem::declareTriangleBuilds(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed)
{
    const bool usesBvh = scene.backend() == RayBackend::ComputeBvh;
    posed.scene = graph.importBuffer("scene", scene.tracedBytes());
    posed.sceneUse = usesBvh ? Use::StorageRead : Use::AccelRead;
    if (chosen_.empty()) {
        graph.skip("triangle builds", view.characters.empty() ? "no DynamicSkinned in the scene" : "no pose changed");
        return;
    }
    graph::Pass pass = graph.add("triangle builds");
    pass.read(posed.vertices, usesBvh ? Use::StorageRead : Use::AccelBuildInput);
    posed.scene = pass.write(posed.scene, usesBvh ? Use::StorageWrite : Use::AccelWrite);
    pass.record([this, &view, &scene, usesBvh](graph::Recorder& recorder) {
        if (usesBvh)
            recordRefits(recorder, view, scene);
        else
            recordAccelBuilds(recorder, view, chosen_, scene);
    });
}

void PosingSystem::declareBoxBuilds(graph::FrameGraph& graph, const GpuScene& scene, const FieldFrame& fields, Posed& posed)
{
    if (fields && scene.backend() == RayBackend::RayQuery) {
        fieldBoxes_.declare(graph, fields, posed.scene);
        return;
    }
    fieldBoxes_.drop();
    graph.skip("box builds", fields ? "compute-bvh asks each group of steps" : "no SDFPrimitive in the scene");
}

void PosingSystem::declareSceneBuild(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed)
{
    const bool usesBvh = scene.backend() == RayBackend::ComputeBvh;
    graph::Pass pass = graph.add("scene build");
    if (posed.vertices) // nothing but the order: behind the builds of this frame
        pass.read(posed.vertices, usesBvh ? Use::StorageRead : Use::AccelBuildInput);
    posed.scene = pass.write(posed.scene, usesBvh ? Use::StorageWrite : Use::AccelWrite);
    pass.record([this, &view, &scene, usesBvh](graph::Recorder& recorder) {
        if (usesBvh)
            recordBvhScene(recorder, view, scene);
        else
            recordAccelScene(recorder, view, scene);
    });
}

} // namespace antumbra::render
