// Vogel, A better way to construct the sunflower head, 1979, on the disc and, by equal areas, on the sphere (Swinbank and Purser 2006).
#include "bake/directions.h"

#include <algorithm>
#include <cmath>

namespace antumbra::bake {

namespace {

struct Placed
{
    vec3 direction;
    uint32_t order;
};

/// Along a curve that fills the square [-1, 1] x [-1, 1] without leaving a neighbourhood (Morton 1966).
uint32_t orderIn(vec2 square)
{
    const uvec2 cell = uvec2(glm::clamp((0.5f + 0.5f * square) * 1024.0f, 0.0f, 1023.0f));
    uint32_t order = 0;
    for (uint32_t bit = 0; bit < 10; ++bit)
        order |= (cell.x >> bit & 1u) << 2 * bit | (cell.y >> bit & 1u) << (2 * bit + 1);
    return order;
}

/// The sphere unfolded to a square.
vec2 octahedral(vec3 direction)
{
    const vec2 upper = vec2(direction) / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    if (direction.z >= 0)
        return upper;
    return {std::copysign(1.0f - std::abs(upper.y), upper.x), std::copysign(1.0f - std::abs(upper.x), upper.y)};
}

std::vector<DirectionPacket> packed(std::vector<Placed> directions)
{
    std::ranges::stable_sort(directions, {}, &Placed::order);
    std::vector<DirectionPacket> packets(directions.size() / kLanes);
    for (size_t i = 0; i < directions.size(); ++i) {
        DirectionPacket& packet = packets[i / kLanes];
        packet.x[i % kLanes] = directions[i].direction.x;
        packet.y[i % kLanes] = directions[i].direction.y;
        packet.z[i % kLanes] = directions[i].direction.z;
    }
    return packets;
}

vec2 onCircle(uint32_t i)
{
    constexpr double kGoldenAngle = std::numbers::pi * (3 - 2.23606797749978969641);
    return {std::cos(i * kGoldenAngle), std::sin(i * kGoldenAngle)};
}

} // namespace

std::vector<DirectionPacket> cosineDirections(uint32_t packets)
{
    const uint32_t count = packets * kLanes;
    std::vector<Placed> directions;
    for (uint32_t i = 0; i < count; ++i) {
        const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        const vec2 disc = std::sqrt(share) * onCircle(i);
        directions.push_back({vec3(disc, std::sqrt(1.0f - share)), orderIn(disc)});
    }
    return packed(std::move(directions));
}

std::vector<DirectionPacket> sphereDirections(uint32_t packets)
{
    const uint32_t count = packets * kLanes;
    std::vector<Placed> directions;
    for (uint32_t i = 0; i < count; ++i) {
        const float height = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count);
        const vec3 direction(std::sqrt(1.0f - height * height) * onCircle(i), height);
        directions.push_back({direction, orderIn(octahedral(direction))});
    }
    return packed(std::move(directions));
}

void rotate(const mat3& frame, const DirectionPacket& local, DirectionPacket& result)
{
    result.x = frame[0].x * local.x + frame[1].x * local.y + frame[2].x * local.z;
    result.y = frame[0].y * local.x + frame[1].y * local.y + frame[2].y * local.z;
    result.z = frame[0].z * local.x + frame[1].z * local.y + frame[2].z * local.z;
}

uint64_t scrambled(uint64_t key)
{
    uint64_t bits = key + 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

float unitFloat(uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

// Duff et al., Building an Orthonormal Basis, Revisited, 2017: no branch at the poles.
mat3 frameAbout(vec3 normal, float radians)
{
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    const vec3 tangent(1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    const float c = std::cos(radians), s = std::sin(radians);
    return {tangent * c + bitangent * s, bitangent * c - tangent * s, normal};
}

mat3 rotationOf(uint64_t key)
{
    const float height = 1.0f - 2.0f * unitFloat(scrambled(key)), azimuth = 2.0f * kPi * unitFloat(scrambled(key + 1));
    const float radius = std::sqrt(1.0f - height * height);
    return frameAbout({radius * std::cos(azimuth), radius * std::sin(azimuth), height}, 2.0f * kPi * unitFloat(scrambled(key + 2)));
}

} // namespace antumbra::bake
