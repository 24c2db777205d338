// Which texels of the atlas hold surface, and where on it. Knows nothing of light.
#pragma once

#include "bake/static_scene.h"

namespace antumbra::bake {

inline constexpr uint32_t kNoTexel = ~0u;

/// The texels that surface covers, in rows; each with points spread over the part that is covered.
struct TexelMap
{
    uvec2 extent{0};
    std::vector<uvec2> places;         // of texels, in rows
    std::vector<uint32_t> firstPoints; // one a texel and one past the last, into `points`; a texel has a point at least
    std::vector<SurfacePoint> points;
    std::vector<uint32_t> texels; // by y * extent.x + x: index of the texel there, or kNoTexel

    [[nodiscard]] uint32_t texelCount() const { return static_cast<uint32_t>(places.size()); }
    [[nodiscard]] std::span<const SurfacePoint> pointsOf(uint32_t texel) const
    {
        return std::span(points).subspan(firstPoints[texel], firstPoints[texel + 1] - firstPoints[texel]);
    }
};

/// From how many places of a texel a bake's rays leave, where it is fully covered.
inline constexpr uint32_t kPointsPerTexel = 4;

/// At most `mostPoints` points a texel, on a fixed pattern. Does not depend on the order of triangles but where they overlap.
TexelMap mapTexels(const StaticScene& scene, uint32_t mostPoints);

/// The texels that give a value at `bakeUv` by bilinear interpolation, with weights that sum to one: those of `isValid` (one a texel)
/// alone; none where there is none.
struct Footprint
{
    uint32_t texels[4];
    float weights[4];
    uint32_t count = 0;
};
Footprint footprintAt(const TexelMap& map, std::span<const uint8_t> isValid, vec2 bakeUv);

/// For every place of the page, the texel it takes its value from: itself, else the nearest valid one within `reach` texels, else
/// kNoTexel. Keeps bilinear look-ups at the rim of a chart from reading what is not surface.
std::vector<uint32_t> dilated(const TexelMap& map, std::span<const uint8_t> isValid, uint32_t reach);

} // namespace antumbra::bake
