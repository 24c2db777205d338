#include "scene/outline.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace antumbra::scene {

namespace {

constexpr double kCollinear = 1e-6; // of the extent

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c)
{
    const glm::dvec2 ab = b - a;
    const glm::dvec2 ac = c - a;
    return ab.x * ac.y - ab.y * ac.x;
}

/// Half of the hull (Andrew's monotone chain), its last point left out: that one begins the other half.
void addChain(std::span<const glm::dvec2> points, const Loop& order, Loop& outline)
{
    const size_t first = outline.size();
    for (const uint32_t next : order) {
        while (outline.size() >= first + 2 && turn(points[outline[outline.size() - 2]], points[outline.back()], points[next]) <= 0)
            outline.pop_back();
        outline.push_back(next);
    }
    outline.pop_back();
}

/// Without the corners where the outline goes straight on. Not in the chain: it visits points that are no corners, and next to one of
/// those a far corner can look collinear.
Loop withoutCollinear(std::span<const glm::dvec2> points, const Loop& outline, double tolerance)
{
    Loop kept;
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 before = points[kept.empty() ? outline.back() : kept.back()];
        const glm::dvec2 corner = points[outline[i]];
        const glm::dvec2 after = points[outline[(i + 1) % outline.size()]];
        const bool goesOn = glm::dot(corner - before, after - corner) > 0;
        if (!goesOn || turn(before, corner, after) > tolerance * glm::length(after - before))
            kept.push_back(outline[i]);
    }
    return kept;
}

} // namespace

Loop outlineOf(std::span<const glm::dvec2> points)
{
    if (points.empty())
        return {};
    glm::dvec2 lowest = points[0];
    glm::dvec2 highest = points[0];
    for (const glm::dvec2& point : points) {
        lowest = glm::min(lowest, point);
        highest = glm::max(highest, point);
    }
    const glm::dvec2 extent = highest - lowest;
    const double tolerance = kCollinear * std::max(extent.x, extent.y);
    Loop order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(
        order, [&](uint32_t a, uint32_t b) { return std::tie(points[a].x, points[a].y, a) < std::tie(points[b].x, points[b].y, b); });
    Loop outline;
    addChain(points, order, outline);
    std::ranges::reverse(order);
    addChain(points, order, outline);
    return withoutCollinear(points, outline, tolerance);
}

} // namespace antumbra::scene
