#include "bake/ray_scene.h"

#include "base/error.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>

namespace antumbra::bake {

namespace {

/// Triangles that stop every ray, and those that let some through, for which Embree has to ask.
enum Part : uint32_t { Plain, Filtered, kPartCount };

struct Release
{
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

Error outOfMemory() { return {"Embree cannot build its tree: out of memory", "ray tracing", ExitCode::NoDevice}; }

bool countBytes(void* total, ssize_t bytes, bool)
{
    static_cast<std::atomic<int64_t>*>(total)->fetch_add(bytes);
    return true;
}

} // namespace

struct RayScene::Embree
{
    explicit Embree(const StaticScene& staticScene);

    void attach(Part part);
    static void skipUnseen(const RTCFilterFunctionNArguments* arguments);

    const StaticScene& surfaces;
    std::atomic<int64_t> bytes = 0;
    std::array<std::vector<uint32_t>, kPartCount> triangles; // of the scene, by Embree's number within the part
    Owned<RTCDevice> device;
    Owned<RTCScene> scene;
};

// One thread builds, so that the tree, and by it which of two coincident triangles is met, is the same every time.
RayScene::Embree::Embree(const StaticScene& staticScene) : surfaces(staticScene), device(rtcNewDevice("threads=1"))
{
    if (!device)
        throw Error("Embree does not start on this machine", "ray tracing", ExitCode::NoDevice);
    rtcSetDeviceMemoryMonitorFunction(device.get(), countBytes, &bytes);
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    for (uint32_t triangle = 0; triangle < surfaces.triangleCount(); ++triangle) {
        const scene::Material& material = surfaces.materials[surfaces.triangleMaterials[triangle]];
        triangles[material.twoSided || material.alphaCutoff > 0 ? Filtered : Plain].push_back(triangle);
    }
    attach(Plain);
    attach(Filtered);
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE)
        throw outOfMemory();
}

void RayScene::Embree::attach(Part part)
{
    const std::vector<uint32_t>& members = triangles[part];
    if (members.empty())
        return;
    const Owned<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* positions = static_cast<vec3*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), surfaces.positions.size()));
    auto* corners = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), members.size()));
    if (!positions || !corners)
        throw outOfMemory();
    std::ranges::copy(surfaces.positions, positions);
    for (const uint32_t triangle : members)
        corners = std::copy_n(&surfaces.indices[size_t{3} * triangle], 3, corners);
    if (part == Filtered) {
        rtcSetGeometryUserData(geometry.get(), this);
        rtcSetGeometryIntersectFilterFunction(geometry.get(), skipUnseen);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.get(), geometry.get(), part);
}

void RayScene::Embree::skipUnseen(const RTCFilterFunctionNArguments* arguments)
{
    const auto& embree = *static_cast<const Embree*>(arguments->geometryUserPtr);
    const uint32_t count = arguments->N;
    for (uint32_t i = 0; i < count; ++i) {
        if (arguments->valid[i] == 0)
            continue;
        const SurfacePoint point{embree.triangles[Filtered][RTCHitN_primID(arguments->hit, count, i)],
                                 {RTCHitN_u(arguments->hit, count, i), RTCHitN_v(arguments->hit, count, i)}};
        const float facing = RTCRayN_dir_x(arguments->ray, count, i) * RTCHitN_Ng_x(arguments->hit, count, i) +
                             RTCRayN_dir_y(arguments->ray, count, i) * RTCHitN_Ng_y(arguments->hit, count, i) +
                             RTCRayN_dir_z(arguments->ray, count, i) * RTCHitN_Ng_z(arguments->hit, count, i);
        const bool isTwoSided = embree.surfaces.materials[embree.surfaces.triangleMaterials[point.triangle]].twoSided;
        if ((isTwoSided && facing > 0) || isHole(embree.surfaces, point))
            arguments->valid[i] = 0;
    }
}

RayScene::RayScene(const StaticScene& scene) : embree_(std::make_unique<Embree>(scene)), surfaces_(&scene) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

bool RayScene::intersect(vec3 origin, vec3 direction, Hit& hit) const
{
    RTCRayHit query{.ray = {.org_x = origin.x, .org_y = origin.y, .org_z = origin.z}, .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    query.ray.dir_x = direction.x;
    query.ray.dir_y = direction.y;
    query.ray.dir_z = direction.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    hit.point = {embree_->triangles[query.hit.geomID][query.hit.primID], {query.hit.u, query.hit.v}};
    hit.distance = query.ray.tfar;
    hit.isBack = glm::dot(direction, vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z)) > 0;
    return true;
}

void RayScene::intersect(vec3 origin, const DirectionPacket& directions, LaneMask traced, HitPacket& result) const
{
    static_assert(kLanes == 16, "as many as rtcIntersect16 takes");
    alignas(64) std::array<int32_t, kLanes> valid;
    RTCRayHit16 query;
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        valid[lane] = isSet(traced, lane) ? -1 : 0;
        query.ray.org_x[lane] = origin.x;
        query.ray.org_y[lane] = origin.y;
        query.ray.org_z[lane] = origin.z;
        query.ray.tnear[lane] = 0;
        query.ray.time[lane] = 0;
        query.ray.tfar[lane] = std::numeric_limits<float>::infinity();
        query.ray.mask[lane] = ~0u;
        query.ray.flags[lane] = 0;
        query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
    std::memcpy(query.ray.dir_x, &directions.x, sizeof(Lanes));
    std::memcpy(query.ray.dir_y, &directions.y, sizeof(Lanes));
    std::memcpy(query.ray.dir_z, &directions.z, sizeof(Lanes));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), embree_->scene.get(), &context, &query);

    result.hits = result.backs = 0;
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID)
            continue;
        const float facing = query.hit.Ng_x[lane] * query.ray.dir_x[lane] + query.hit.Ng_y[lane] * query.ray.dir_y[lane] +
                             query.hit.Ng_z[lane] * query.ray.dir_z[lane];
        result.hits |= 1u << lane;
        if (facing > 0)
            result.backs |= 1u << lane;
        result.points[lane] = {embree_->triangles[query.hit.geomID[lane]][query.hit.primID[lane]], {query.hit.u[lane], query.hit.v[lane]}};
    }
}

uint64_t RayScene::bytes() const { return static_cast<uint64_t>(embree_->bytes.load()); }

// Interpolation, the way along the ray and Embree's own arithmetic: 2^-24 of the largest term each; sixteen such steps and a micrometre,
// as the shaders' rays keep (surface.glsl).
vec3 rayOrigin(vec3 position, vec3 geometricNormal, float magnitude)
{
    const float error = 1.0e-6f * magnitude + 1.0e-6f;
    return position + geometricNormal * (4.0f * error);
}

vec3 rayOrigin(const StaticScene& scene, const SurfacePoint& point)
{
    vec3 largest{0};
    for (uint32_t corner = 0; corner < 3; ++corner)
        largest = glm::max(largest, glm::abs(scene.positions[scene.indices[size_t{3} * point.triangle + corner]]));
    return rayOrigin(positionAt(scene, point), geometricNormal(scene, point.triangle), std::max({largest.x, largest.y, largest.z}));
}

} // namespace antumbra::bake
