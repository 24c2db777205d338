#include "bake/texel_rays.h"

#include "bake/ray_scene.h"

#include <algorithm>

namespace antumbra::bake {

TexelRays::TexelRays(const StaticScene& surfaces, const TexelMap& map, uint32_t raysPerTexel)
    : surfaces_(surfaces), map_(map), packetsPerTexel_((std::max(raysPerTexel, 1u) + kLanes - 1) / kLanes)
{
}

TexelRays::Leaving TexelRays::leavingFrom(uint32_t texel, uint32_t point)
{
    const std::span<const SurfacePoint> points = map_.pointsOf(texel);
    const uint32_t used = pointCount(texel);
    const SurfacePoint& place = points[point * points.size() / used];
    const uint64_t key = scrambled(uint64_t{map_.places[texel].y} << 32 | map_.places[texel].x);
    return {.origin = rayOrigin(surfaces_, place),
            .normal = geometricNormal(surfaces_, place.triangle),
            .frame = frameAbout(shadingNormalAt(surfaces_, place), 2 * kPi * unitFloat(scrambled(key + point))),
            .pattern = &patternFor(used)};
}

const std::vector<DirectionPacket>& TexelRays::patternFor(uint32_t points)
{
    if (patterns_.size() <= points)
        patterns_.resize(points + 1);
    if (patterns_[points].empty())
        patterns_[points] = cosineDirections(raysPerPoint(points) / kLanes);
    return patterns_[points];
}

} // namespace antumbra::bake
