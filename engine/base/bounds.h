// Boxes, spheres and capsules, in the space their holder names.
#pragma once

#include "base/math.h"

#include <limits>

namespace antumbra {

/// Axis-aligned box; empty (lowest > highest) until something is added.
struct Aabb
{
    vec3 lowest{std::numeric_limits<float>::max()};
    vec3 highest{std::numeric_limits<float>::lowest()};

    void add(vec3 point)
    {
        lowest = glm::min(lowest, point);
        highest = glm::max(highest, point);
    }
    void add(const Aabb& other)
    {
        lowest = glm::min(lowest, other.lowest);
        highest = glm::max(highest, other.highest);
    }
    [[nodiscard]] bool isEmpty() const { return lowest.x > highest.x; }
    [[nodiscard]] vec3 centre() const { return 0.5f * (lowest + highest); }
    [[nodiscard]] vec3 extent() const { return isEmpty() ? vec3{0} : highest - lowest; }
    [[nodiscard]] float surfaceArea() const
    {
        const vec3 e = extent();
        return 2.0f * (e.x * e.y + e.y * e.z + e.z * e.x);
    }
};

/// The same of the plane.
struct Rect
{
    vec2 lowest{std::numeric_limits<float>::max()};
    vec2 highest{std::numeric_limits<float>::lowest()};

    void add(vec2 point)
    {
        lowest = glm::min(lowest, point);
        highest = glm::max(highest, point);
    }
    [[nodiscard]] vec2 extent() const { return highest - lowest; }
};

struct Sphere
{
    vec3 centre{0};
    float radius = 0;
};

/// All points within `radius` of the segment a-b.
struct Capsule
{
    vec3 a{0};
    vec3 b{0};
    float radius = 0;
};

} // namespace antumbra
