#include "gpu/traced_scene.h"

#include "gpu/dispatch.h"
#include "render/shader_structs.h"
#include "render/shadow/bvh.h"

namespace antumbra {

namespace {

template <class T>
VkDeviceAddress keep(std::vector<gpu::Buffer>& buffers, gpu::Device& device, const std::vector<T>& values)
{
    return buffers.emplace_back(gpu::uploadedBuffer(device, "traced", std::span<const T>(values))).address();
}

gpu::Accel built(gpu::Device& device, VkAccelerationStructureTypeKHR type, const gpu::AccelSizes& sizes, const auto& record)
{
    gpu::Accel accel(device, "traced", type, sizes.structure);
    const gpu::Buffer scratch(device, "scratch", sizes.scratch);
    device.submitNow([&](VkCommandBuffer commands) { record(commands, accel, scratch.address()); });
    return accel;
}

} // namespace

TracedScene::TracedScene(gpu::Device& device, render::RayBackend backend, std::vector<PlacedMesh>& meshes)
{
    for (PlacedMesh& placed : meshes)
        orderTriangles(placed.mesh, placed.mesh.positions);
    if (backend == render::RayBackend::RayQuery)
        buildAccels(device, meshes);
    else
        buildBvhs(device, meshes);
}

void TracedScene::buildAccels(gpu::Device& device, const std::vector<PlacedMesh>& meshes)
{
    std::vector<VkAccelerationStructureInstanceKHR> instances;
    for (const PlacedMesh& placed : meshes) {
        const scene::Mesh& mesh = placed.mesh;
        const gpu::TriangleInput input{keep(buffers_, device, mesh.positions), keep(buffers_, device, mesh.indices),
                                       static_cast<uint32_t>(mesh.positions.size()), static_cast<uint32_t>(mesh.indices.size() / 3)};
        const gpu::Accel& accel =
            accels_.emplace_back(built(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
                                       gpu::trianglesSizes(device, input.vertexCount, input.triangleCount, false),
                                       [&](VkCommandBuffer commands, const gpu::Accel& target, VkDeviceAddress scratch) {
                                           gpu::recordBuild(commands, target, input, false, scratch);
                                       }));
        instances.push_back(gpu::instanceOf(placed.worldFromLocal, accel, placed.mask));
    }
    buildScene(device, instances);
}

TracedScene::TracedScene(gpu::Device& device, const std::vector<VkAabbPositionsKHR>& boxes)
{
    const gpu::BoxInput input{keep(buffers_, device, boxes), static_cast<uint32_t>(boxes.size())};
    const gpu::Accel& accel =
        accels_.emplace_back(built(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, gpu::boxesSizes(device, input.boxCount),
                                   [&](VkCommandBuffer commands, const gpu::Accel& target, VkDeviceAddress scratch) {
                                       gpu::recordBuild(commands, target, input, scratch);
                                   }));
    buildScene(device, {gpu::instanceOf(mat4{1}, accel, shader::kMaskFields)});
}

void TracedScene::buildScene(gpu::Device& device, const std::vector<VkAccelerationStructureInstanceKHR>& instances)
{
    const VkDeviceAddress uploaded = keep(buffers_, device, instances);
    const auto count = static_cast<uint32_t>(instances.size());
    address_ = accels_
                   .emplace_back(built(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, gpu::instancesSizes(device, count),
                                       [&](VkCommandBuffer commands, const gpu::Accel& target, VkDeviceAddress scratch) {
                                           gpu::recordBuild(commands, target, uploaded, count, scratch);
                                       }))
                   .address();
}

void TracedScene::buildBvhs(gpu::Device& device, const std::vector<PlacedMesh>& meshes)
{
    std::vector<shader::BvhPlacement> placements;
    for (const PlacedMesh& placed : meshes) {
        const scene::Mesh& mesh = placed.mesh;
        const mat4 rows = glm::transpose(glm::inverse(placed.worldFromLocal));
        placements.push_back({.worldFromLocal = placed.worldFromLocal,
                              .instance = {.localFromWorld = {rows[0], rows[1], rows[2]},
                                           .nodes = keep(buffers_, device, render::bvhOf(mesh.positions, mesh.indices)),
                                           .positions = keep(buffers_, device, mesh.positions),
                                           .indices = keep(buffers_, device, mesh.indices),
                                           .leafCount = render::bvhLeafCount(static_cast<uint32_t>(mesh.indices.size() / 3)),
                                           .mask = placed.mask}});
    }
    const auto count = static_cast<uint32_t>(placements.size());
    const VkDeviceAddress uploaded = keep(buffers_, device, placements);
    const gpu::Buffer& scene =
        buffers_.emplace_back(device, "traced scene", sizeof(shader::BvhScene) + count * sizeof(shader::BvhInstance));
    dispatchNow(device, gpu::computePipeline(device, "bvh_scene.comp"),
                shader::BvhSceneDispatch{uploaded, scene.address() + sizeof(shader::BvhScene), scene.address(), count}, count);
    address_ = scene.address();
}

} // namespace antumbra
