#include "tools/lab/embree_alone.h"

#include "tools/lab/stopwatch.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace antumbra::lab {

EmbreeAlone::EmbreeAlone(const bake::StaticScene& surfaces) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get()))
{
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    std::ranges::copy(surfaces.positions, static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                                     sizeof(vec3), surfaces.positions.size())));
    std::ranges::copy(surfaces.indices, static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                                       3 * sizeof(uint32_t), surfaces.triangleCount())));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
}

void EmbreeAlone::add(vec3 origin, const bake::DirectionPacket& directions, bake::LaneMask traced)
{
    Packet& packet = packets_.emplace_back(); // zero
    for (uint32_t lane = 0; lane < bake::kLanes; ++lane) {
        packet.valid[lane] = bake::isSet(traced, lane) ? -1 : 0;
        packet.rays.ray.org_x[lane] = origin.x;
        packet.rays.ray.org_y[lane] = origin.y;
        packet.rays.ray.org_z[lane] = origin.z;
        packet.rays.ray.tfar[lane] = std::numeric_limits<float>::infinity();
        packet.rays.ray.mask[lane] = ~0u;
        packet.rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
    std::memcpy(packet.rays.ray.dir_x, &directions.x, sizeof(directions.x));
    std::memcpy(packet.rays.ray.dir_y, &directions.y, sizeof(directions.y));
    std::memcpy(packet.rays.ray.dir_z, &directions.z, sizeof(directions.z));
}

double EmbreeAlone::trace()
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const double milliseconds = millisecondsOf([&] {
        for (Packet& packet : packets_)
            rtcIntersect16(packet.valid, scene_.get(), &context, &packet.rays);
    });
    packets_.clear();
    return milliseconds;
}

} // namespace antumbra::lab
