// Connected regions of a surface that face one way. Knows nothing of planes or texels.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace antumbra::bake {

/// Where a surface is and nothing else: no two vertices at one place, so that triangles that meet share them.
struct Surface
{
    std::vector<vec3> positions;   // metres
    std::vector<uint32_t> indices; // three a triangle, which has an area

    [[nodiscard]] uint32_t triangleCount() const { return static_cast<uint32_t>(indices.size() / 3); }
};

/// So far, in radians, a triangle's normal strays at most from its region's axis.
inline constexpr float kRegionHalfAngle = 35 * kPi / 180;

struct Region
{
    vec3 axis{0};                    // unit
    std::vector<uint32_t> triangles; // in order
};

/// For every triangle those of its region across its edges.
struct Neighbours
{
    std::vector<uint32_t> firsts; // one a triangle and one past the last, into `triangles`
    std::vector<uint32_t> triangles;

    [[nodiscard]] std::span<const uint32_t> of(uint32_t triangle) const
    {
        return std::span(triangles).subspan(firsts[triangle], firsts[triangle + 1] - firsts[triangle]);
    }
};

struct Regions
{
    std::vector<Region> regions;
    Neighbours neighbours;
};

vec3 normalOf(const Surface& surface, uint32_t triangle); // unit

/// Every triangle in one region. Which depends on the order of the triangles where edges are equally flat.
Regions regionsOf(const Surface& surface);

} // namespace antumbra::bake
