// A few meshes made ready for rays by either back-end, or boxes by ray query, without renderer and scene.
#pragma once

#include "gpu/accel.h"
#include "render/knobs.h"
#include "scene/mesh.h"

namespace antumbra {

struct PlacedMesh
{
    scene::Mesh mesh; // its triangles are put into the loader's order
    mat4 worldFromLocal{1};
    uint32_t mask = 0; // shader::kMaskStatic or kMaskDynamic
};

class TracedScene
{
public:
    TracedScene(gpu::Device& device, render::RayBackend backend, std::vector<PlacedMesh>& meshes);

    /// As distance fields, kMaskFields; never of none.
    TracedScene(gpu::Device& device, const std::vector<VkAabbPositionsKHR>& boxes);

    /// As OcclusionTrace::scene takes it.
    [[nodiscard]] VkDeviceAddress address() const { return address_; }

private:
    void buildAccels(gpu::Device& device, const std::vector<PlacedMesh>& meshes);
    void buildScene(gpu::Device& device, const std::vector<VkAccelerationStructureInstanceKHR>& instances);
    void buildBvhs(gpu::Device& device, const std::vector<PlacedMesh>& meshes);

    std::vector<gpu::Buffer> buffers_;
    std::vector<gpu::Accel> accels_;
    VkDeviceAddress address_ = 0;
};

} // namespace antumbra
