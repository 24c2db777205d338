// What Embree does without a baker around it: the same rays, made before the clock runs, through a tree of the same triangles.
#pragma once

#include "bake/directions.h"
#include "bake/static_scene.h"

#include <embree3/rtcore.h>

#include <memory>
#include <vector>

namespace antumbra::lab {

class EmbreeAlone
{
public:
    explicit EmbreeAlone(const bake::StaticScene& surfaces);

    /// Only lanes of `traced` are rays.
    void add(vec3 origin, const bake::DirectionPacket& directions, bake::LaneMask traced);
    /// Milliseconds that all rays take, on this thread; afterwards there are none.
    double trace();
    /// The same where there are `packets` of them; else 0, and they wait.
    double traceAfter(size_t packets) { return packets_.size() < packets ? 0 : trace(); }

private:
    struct Release
    {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    struct alignas(64) Packet
    {
        int32_t valid[bake::kLanes];
        RTCRayHit16 rays;
    };

    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> scene_;
    std::vector<Packet> packets_;
};

} // namespace antumbra::lab
