// What the scene keeps on the device between frames: models, environments, posed characters, and what rays are traced through.
// Only what a frame's view names is ever made; what it no longer names is given back.
#pragma once

#include "gpu/accel.h"
#include "gpu/image.h"
#include "render/clusters.h"
#include "render/frame_view.h"
#include "render/shader_structs.h"
#include "scene/assets.h"

#include <optional>
#include <vector>

namespace antumbra::render {

struct DeviceMaterial
{
    shader::MaterialBlock block;
    bool isTwoSided = false;
};

/// A model's streams as skinning, drawing and tracing read them.
struct DeviceModel
{
    gpu::Buffer indices;        // as tracing takes them
    gpu::Buffer clusterIndices; // as the clusters count them
    gpu::Buffer uvs;
    gpu::Buffer bakeUvs; // made once it is drawn with baked light
    gpu::Buffer nodes;   // BvhNode[], at rest; made for compute-bvh once something moves in the scene
    std::vector<Cluster> clusters;
    std::vector<DeviceMaterial> materials;
    std::vector<gpu::Image> images;
    uint32_t vertexCount = 0;
    uint32_t triangleCount = 0;
    vec3 meanAlbedo{0};
};

/// What only posed models need.
struct DeviceSkin
{
    gpu::Buffer bindPositions, bindNormals, influences, morphs, morphOffsets, bones, boneVertices;
    uint32_t jointCount = 0;
    uint32_t morphCount = 0;
    uint32_t boneCount = 0;
};

/// A model at rest, for static objects.
struct DeviceRest
{
    gpu::Buffer positions, normals;
    gpu::Accel accel; // made for ray-query once something moves in the scene
};

/// One posed character.
struct DeviceCharacter
{
    uint32_t model = 0;
    gpu::Buffer positions, normals, capsules, sphere;
    gpu::Accel accel; // ray-query
    gpu::Buffer scratch;
    gpu::Buffer nodes;        // compute-bvh: BvhNode[]
    uint64_t poseVersion = 0; // of what the buffers hold
    bool isPosed = false;
    uint64_t posedInFrame = 0;
};

class GpuScene
{
public:
    GpuScene(gpu::Device& device, const scene::Assets& assets);

    /// Makes what the view needs and the device lacks, and drops what left the view. Allocates nothing for a view like the last.
    void prepare(const FrameView& view);

    [[nodiscard]] const DeviceModel& model(uint32_t index) const { return *models_[index]; }
    [[nodiscard]] const DeviceSkin& skin(uint32_t model) const { return *skins_[model]; }
    [[nodiscard]] const DeviceRest& rest(uint32_t model) const { return *rests_[model]; }
    [[nodiscard]] DeviceCharacter& character(uint32_t slot) { return *characters_[slot]; }
    [[nodiscard]] const DeviceCharacter& character(uint32_t slot) const { return *characters_[slot]; }
    [[nodiscard]] const gpu::Image& environment(uint32_t index) const { return *environments_[index]; }
    /// What the view's rays are traced with. Nothing is kept for the other backend.
    [[nodiscard]] RayBackend backend() const { return backend_; }
    /// What rays are traced through, absent where no pass traces any: an acceleration structure, or a BvhScene and its instances.
    [[nodiscard]] const gpu::Accel& scene() const { return scene_; }
    [[nodiscard]] const gpu::Buffer& sceneScratch() const { return sceneScratch_; }
    [[nodiscard]] const gpu::Buffer& bvhScene() const { return bvhScene_; }
    /// That of the backend, as OcclusionTrace::scene takes it.
    [[nodiscard]] VkDeviceAddress tracedAddress() const { return usesBvh() ? bvhScene_.address() : scene_.address(); }
    [[nodiscard]] size_t tracedBytes() const { return usesBvh() ? bvhScene_.bytes() : scene_.bytes(); }
    [[nodiscard]] const gpu::Buffer& blockers() const { return blockers_; }
    [[nodiscard]] const gpu::Buffer& capsules() const { return capsules_; }
    /// How often prepare() had to make or drop something.
    [[nodiscard]] uint64_t changes() const { return changes_; }

private:
    void makeModel(uint32_t index);
    void makeBakeUvs(uint32_t index);
    void makeSkin(uint32_t index);
    void makeRest(uint32_t index);
    void makeCharacter(uint32_t slot, uint32_t model);
    void useBackend(RayBackend backend);
    void makeTraced(const FrameView& view);
    void makeTracedCharacter(DeviceCharacter& character, const DeviceModel& model);
    void makeTracedScene(uint32_t instanceCount);
    void buildRest(uint32_t index);
    void makeNodes(uint32_t index);
    void makeBounds(const FrameView& view);
    void makeEnvironment(uint32_t index);
    void dropTraced();
    void dropCharacters(const FrameView& view);

    [[nodiscard]] bool usesBvh() const { return backend_ == RayBackend::ComputeBvh; }

    gpu::Device* device_;
    const scene::Assets* assets_;
    RayBackend backend_ = RayBackend::Auto; // until the first view
    std::vector<std::optional<DeviceModel>> models_;
    std::vector<std::optional<DeviceSkin>> skins_;
    std::vector<std::optional<DeviceRest>> rests_;
    std::vector<std::optional<DeviceCharacter>> characters_; // by slot
    std::vector<std::optional<gpu::Image>> environments_;
    gpu::Accel scene_;
    gpu::Buffer sceneScratch_, bvhScene_, blockers_, capsules_;
    uint32_t sceneInstances_ = 0;
    uint32_t capsuleCount_ = 0;
    uint32_t blockerCount_ = 0;
    uint64_t changes_ = 0;
};

} // namespace antumbra::render
