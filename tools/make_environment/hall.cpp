#include "tools/make_environment/radiance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace antumbra::environment {

namespace {

// Metres, from the eye in the middle of the hall.
constexpr dvec3 kHalfRoom{6.5, 0, 13};
constexpr double kFloor = -1.6, kCeiling = 7.4;

constexpr double kBay = 3.7; // from window to window along z

/// The sky outside, brighter on the left, where it is afternoon.
constexpr dvec3 kOutsideLeft{13, 11.2, 8.6}, kOutsideRight{5.8, 6.8, 8.4}, kOutsideEnd{9, 9.2, 9.6};

/// 0..1: how much of the point lies in an arched window; `across` from the window's middle, `height` above the eye.
double inWindow(double across, double height, double halfWidth, double sill, double spring)
{
    constexpr double kSoftEdge = 0.05, kMullion = 0.06;
    const double above = std::max(height - spring, 0.0);
    const double outline = halfWidth - std::sqrt(across * across + above * above);
    const double open = glm::smoothstep(0.0, kSoftEdge, std::min(outline, height - sill));
    const double bars = std::min(std::abs(across), std::abs(height - spring));
    return open * glm::mix(0.12, 1.0, glm::smoothstep(kMullion, kMullion + kSoftEdge, bars));
}

double inSideWindows(const dvec3& point)
{
    const double across = point.z - kBay * std::round(point.z / kBay);
    return std::abs(point.z) < 2.5 * kBay + 1 ? inWindow(across, point.y, 0.85, 0.2, 4.6) : 0;
}

double inEndWindows(const dvec3& point)
{
    const double sides = std::max(inWindow(point.x - 2.6, point.y, 0.7, 0.6, 4.2), inWindow(point.x + 2.6, point.y, 0.7, 0.6, 4.2));
    return std::max(inWindow(point.x, point.y, 1.1, 0.6, 4.9), sides);
}

/// Light that the windows leave on the stone: pools across the floor from the left, fading towards floor and ceiling.
dvec3 stone(const dvec3& point, const dvec3& albedo)
{
    const double fromLeft = (point.x + kHalfRoom.x) / (2 * kHalfRoom.x), height = (point.y - kFloor) / (kCeiling - kFloor);
    const double rhythm = 0.75 + 0.25 * std::cos(2 * std::numbers::pi * point.z / kBay);
    const double pool = std::exp(-std::pow((fromLeft - 0.42) / 0.2, 2)) * std::pow(1 - height, 2) * rhythm * rhythm;
    const double fill = 0.55 + 0.45 * std::exp(-std::pow((height - 0.35) / 0.4, 2));
    return albedo * (fill * dvec3{0.92, 0.86, 0.77} * (0.5 + 0.5 * fromLeft) + 2.2 * pool * dvec3{1.0, 0.84, 0.62});
}

} // namespace

dvec3 hall(const dvec3& direction)
{
    const std::array toWall{kHalfRoom.x / std::max(std::abs(direction.x), 1e-9),
                            (direction.y < 0 ? kFloor : kCeiling) / std::copysign(std::max(std::abs(direction.y), 1e-9), direction.y),
                            kHalfRoom.z / std::max(std::abs(direction.z), 1e-9)};
    const double distance = *std::ranges::min_element(toWall);
    const dvec3 point = distance * direction;

    if (distance == toWall[1]) {
        const double beam = direction.y > 0 && std::abs(point.z / kBay - std::floor(point.z / kBay) - 0.5) < 0.1 ? 0.55 : 1;
        return stone(point, direction.y < 0 ? dvec3{0.34, 0.29, 0.23} : beam * dvec3{0.24, 0.18, 0.13});
    }
    const dvec3 wall = stone(point, {0.36, 0.32, 0.27});
    const double skyShare = 0.8 + 0.2 * glm::smoothstep(0.0, 5.0, point.y);
    if (distance == toWall[0])
        return glm::mix(wall, skyShare * (point.x < 0 ? kOutsideLeft : kOutsideRight), inSideWindows(point));
    return direction.z < 0 ? glm::mix(wall, skyShare * kOutsideEnd, inEndWindows(point)) : wall;
}

} // namespace antumbra::environment
