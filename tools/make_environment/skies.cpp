// Overcast: the CIE standard overcast sky, L = Lz (1 + 2 sin(elevation)) / 3 (Moon and Spencer 1942), with slight clouds.
#include "tools/make_environment/radiance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace antumbra::environment {

namespace {

/// -1..1, fixed for each point of the integer lattice.
double latticeValue(const glm::ivec3& at)
{
    uint32_t hash =
        static_cast<uint32_t>(at.x) * 0x8DA6B343u ^ static_cast<uint32_t>(at.y) * 0xD8163841u ^ static_cast<uint32_t>(at.z) * 0xCB1AB31Fu;
    hash = (hash ^ (hash >> 15)) * 0x2C1B3C6Du;
    hash = (hash ^ (hash >> 12)) * 0x297A2D39u;
    return static_cast<double>(hash >> 8) / (1 << 23) - 1;
}

/// Value noise, smooth, -1..1.
double noise(const dvec3& point)
{
    const dvec3 floor = glm::floor(point), t = point - floor, s = t * t * (3.0 - 2.0 * t);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 bit{corner & 1, (corner >> 1) & 1, corner >> 2};
        const dvec3 share = glm::mix(1.0 - s, s, dvec3(bit));
        sum += share.x * share.y * share.z * latticeValue(glm::ivec3(floor) + bit);
    }
    return sum;
}

/// Wider overhead than at the horizon, as on a flat layer seen from below; -1..1.
double clouds(const dvec3& direction)
{
    const dvec3 onLayer = direction / (direction.y + 0.22);
    double sum = 0, weight = 0.5;
    for (int octave = 1; octave <= 16; octave *= 2, weight *= 0.5)
        sum += weight * noise(static_cast<double>(octave) * dvec3{1.3 * onLayer.x, 0.5 * octave, 1.3 * onLayer.z});
    return sum;
}

/// From `below` to `above` within a few degrees of the horizon.
dvec3 acrossHorizon(const dvec3& below, const dvec3& above, double sineOfElevation)
{
    return glm::mix(below, above, glm::smoothstep(-0.035, 0.01, sineOfElevation));
}

} // namespace

dvec3 overcast(const dvec3& direction)
{
    const double up = std::max(direction.y, 0.0);
    const double brightness = (1 + 2 * up) / 3 * (1 + 0.35 * clouds({direction.x, up, direction.z}) * glm::smoothstep(0.0, 0.25, up));
    const dvec3 tint = glm::mix(dvec3{1.02, 1.0, 0.97}, dvec3{0.93, 1.0, 1.09}, up);
    const dvec3 ground = glm::mix(dvec3{0.17, 0.16, 0.14}, dvec3{0.12, 0.112, 0.1}, std::max(-direction.y, 0.0));
    return acrossHorizon(ground, brightness * tint, direction.y);
}

dvec3 lowSun(const dvec3& direction)
{
    constexpr double kElevation = 32 * std::numbers::pi / 180, kAzimuth = 50 * std::numbers::pi / 180; // left of -Z
    constexpr double kRadius = 2.5 * std::numbers::pi / 180;
    const dvec3 sun{-std::cos(kElevation) * std::sin(kAzimuth), std::sin(kElevation), -std::cos(kElevation) * std::cos(kAzimuth)};
    const double angle = std::acos(std::clamp(glm::dot(direction, sun), -1.0, 1.0));
    const double up = std::max(direction.y, 0.0);
    const double towardsSun = 0.5 + 0.5 * std::cos(angle);

    const dvec3 zenith{0.16, 0.26, 0.47};
    const dvec3 horizon = glm::mix(dvec3{0.36, 0.42, 0.56}, dvec3{1.15, 0.78, 0.46}, towardsSun * towardsSun);
    const dvec3 glow = 1.1 * std::exp(-angle / 0.3) * dvec3{1.0, 0.58, 0.25} + 5.0 * std::exp(-angle / 0.055) * dvec3{1.0, 0.7, 0.4};
    const double disc = 1 - glm::smoothstep(0.9 * kRadius, 1.1 * kRadius, angle);
    const dvec3 sky = glm::mix(horizon, zenith, std::pow(up, 0.42)) + glow + disc * 640.0 * dvec3{1.0, 0.74, 0.45};
    const dvec3 ground = glm::mix(dvec3{0.2, 0.165, 0.13}, dvec3{0.29, 0.215, 0.145}, towardsSun);
    return acrossHorizon(ground, sky, direction.y);
}

} // namespace antumbra::environment
