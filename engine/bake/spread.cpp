#include "bake/spread.h"

#include "base/bounds.h"

#include <algorithm>
#include <cmath>

namespace antumbra::bake {

namespace {

struct Farthest
{
    uint32_t point = 0;
    double distance = -1;
};

template <typename Distance>
Farthest farthest(std::span<const glm::dvec3> points, Distance distance)
{
    Farthest result;
    for (uint32_t i = 0; i < points.size(); ++i) {
        const double here = distance(points[i]);
        if (here > result.distance)
            result = {i, here};
    }
    return result;
}

} // namespace

Spread spreadOf(std::span<const glm::dvec3> points, double tolerance)
{
    const auto fromCorner = [&](uint32_t corner) {
        return farthest(points, [&, corner](const glm::dvec3& point) { return glm::distance(point, points[corner]); });
    };
    const uint32_t first = fromCorner(0).point;
    const Farthest second = fromCorner(first);
    if (second.distance <= tolerance)
        return {0, {first}};
    const glm::dvec3 origin = points[first];
    const glm::dvec3 along = (points[second.point] - origin) / second.distance;
    const Farthest third = farthest(points, [&](const glm::dvec3& point) { return glm::length(glm::cross(along, point - origin)); });
    if (third.distance <= tolerance)
        return {1, {first, second.point}};
    const glm::dvec3 normal = glm::normalize(glm::cross(along, points[third.point] - origin));
    const Farthest fourth = farthest(points, [&](const glm::dvec3& point) { return std::abs(glm::dot(normal, point - origin)); });
    if (fourth.distance <= tolerance)
        return {2, {first, second.point, third.point}};
    return {3, {first, second.point, third.point, fourth.point}};
}

std::vector<glm::dvec3> atUnitExtent(std::span<const vec3> points)
{
    Aabb box;
    for (const vec3& point : points)
        box.add(point);
    const glm::dvec3 lowest(box.lowest);
    const glm::dvec3 extent = glm::dvec3(box.highest) - lowest;
    const double greatest = std::max({extent.x, extent.y, extent.z});
    std::vector<glm::dvec3> moved;
    moved.reserve(points.size());
    for (const vec3& point : points)
        moved.push_back((glm::dvec3(point) - lowest) / (greatest > 0 ? greatest : 1));
    return moved;
}

} // namespace antumbra::bake
