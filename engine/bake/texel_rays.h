// The rays that texels are gathered with, packet by packet. They depend on the texel's place alone; traces none of them.
#pragma once

#include "bake/directions.h"
#include "bake/texels.h"

#include <algorithm>

namespace antumbra::bake {

/// Keeps its patterns of directions from texel to texel. Every thread has its own.
class TexelRays
{
public:
    /// Both must outlive it. `raysPerTexel` is rounded up to whole packets at every point.
    TexelRays(const StaticScene& surfaces, const TexelMap& map, uint32_t raysPerTexel);

    /// From how many places rays leave the texel.
    [[nodiscard]] uint32_t pointCount(uint32_t texel) const
    {
        return std::min(static_cast<uint32_t>(map_.pointsOf(texel).size()), packetsPerTexel_);
    }
    /// Of a texel of so many points, those below the surface included.
    [[nodiscard]] uint32_t raysPerPoint(uint32_t points) const { return (packetsPerTexel_ + points - 1) / points * kLanes; }

    /// Calls visit(origin, directions, above) for every packet of one point; only the lanes of `above` leave on the outer side of the
    /// surface. Directions are as dense as the cosine to the shading normal.
    template <class Visit>
    void forEach(uint32_t texel, uint32_t point, Visit&& visit)
    {
        const Leaving leaving = leavingFrom(texel, point);
        for (const DirectionPacket& local : *leaving.pattern) {
            DirectionPacket directions;
            rotate(leaving.frame, local, directions);
            visit(leaving.origin, directions, lanesAbove(directions, leaving.normal));
        }
    }

private:
    struct Leaving
    {
        vec3 origin;
        vec3 normal; // geometric
        mat3 frame;  // about the shading normal
        const std::vector<DirectionPacket>* pattern;
    };

    static LaneMask lanesAbove(const DirectionPacket& directions, vec3 normal)
    {
        const Lanes height = directions.x * normal.x + directions.y * normal.y + directions.z * normal.z;
        LaneMask above = 0;
        for (uint32_t lane = 0; lane < kLanes; ++lane)
            if (height[lane] > 0)
                above |= 1u << lane;
        return above;
    }

    Leaving leavingFrom(uint32_t texel, uint32_t point);
    const std::vector<DirectionPacket>& patternFor(uint32_t points);

    const StaticScene& surfaces_;
    const TexelMap& map_;
    uint32_t packetsPerTexel_;
    std::vector<std::vector<DirectionPacket>> patterns_; // by number of points
};

} // namespace antumbra::bake
