// In how many dimensions points spread: what a hull must know before it begins.
#pragma once

#include "base/math.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace antumbra::bake {

/// Corners that span the points: two far apart, the one farthest from their line, the one farthest from that plane. The first
/// `dimensions` + 1 of them count.
struct Spread
{
    uint32_t dimensions = 0;
    std::array<uint32_t, 4> corners{};
};

/// Points that lie within `tolerance` of a lower dimension do not spread in the next. At least one point.
Spread spreadOf(std::span<const glm::dvec3> points, double tolerance);

/// The points moved and scaled to a greatest extent of one; unscaled where that is zero.
std::vector<glm::dvec3> atUnitExtent(std::span<const vec3> points);

} // namespace antumbra::bake
