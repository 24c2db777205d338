#include "scene/mesh_body.h"

#include "base/check.h"
#include "scene/merged_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace antumbra::scene {

namespace {

constexpr double kLeastHeight = 1e-6; // of the longest edge

/// The points without those that lie within `distance` of an earlier one, and which of them each point has become.
struct Welded
{
    std::vector<vec3> points;
    std::vector<uint32_t> places;
};

Welded weld(std::span<const vec3> points, double distance)
{
    using Cell = std::tuple<int64_t, int64_t, int64_t>;
    std::map<Cell, uint32_t> cells; // of edges as long as the distance, so that a near point is in one of 27
    const auto cellOf = [&](vec3 point) { return glm::floor(glm::dvec3(point) / distance); };
    Welded welded;
    const auto findNear = [&](vec3 point) {
        for (int i = 0; i < 27; ++i) {
            const glm::dvec3 cell = cellOf(point) + glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            const auto found = cells.find({static_cast<int64_t>(cell.x), static_cast<int64_t>(cell.y), static_cast<int64_t>(cell.z)});
            if (found != cells.end() && glm::distance(glm::dvec3(welded.points[found->second]), glm::dvec3(point)) <= distance)
                return found->second;
        }
        return kNoIndex;
    };
    for (const vec3& point : points) {
        uint32_t place = findNear(point);
        if (place == kNoIndex) {
            place = static_cast<uint32_t>(welded.points.size());
            welded.points.push_back(point);
            const glm::dvec3 cell = cellOf(point);
            cells[{static_cast<int64_t>(cell.x), static_cast<int64_t>(cell.y), static_cast<int64_t>(cell.z)}] = place;
        }
        welded.places.push_back(place);
    }
    return welded;
}

bool hasArea(const Loop& triangle, std::span<const vec3> positions)
{
    const glm::dvec3 a(positions[triangle[0]]);
    const glm::dvec3 b(positions[triangle[1]]);
    const glm::dvec3 c(positions[triangle[2]]);
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    return glm::length(glm::cross(b - a, c - a)) > kLeastHeight * longest * longest;
}

} // namespace

std::optional<ConvexBody> meshBody(const Mesh& mesh)
{
    const auto isFinite = [](vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    check(std::ranges::all_of(mesh.positions, isFinite), "positions of a mesh are finite");
    const double rounding = roundingOf(mesh.positions);
    if (rounding == 0)
        return std::nullopt;
    const Welded welded = weld(mesh.positions, rounding);
    std::vector<Loop> loops;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Loop loop{welded.places[mesh.indices[i]], welded.places[mesh.indices[i + 1]], welded.places[mesh.indices[i + 2]]};
        if (loop[0] != loop[1] && loop[1] != loop[2] && loop[2] != loop[0])
            loops.push_back(loop);
    }
    return mergedBody(welded.points, loops, Corners::Rounded);
}

std::vector<ConvexBody> triangleBodies(const Mesh& mesh)
{
    std::vector<ConvexBody> bodies;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Loop triangle{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        if (!hasArea(triangle, mesh.positions))
            continue;
        const std::vector<Loop> loops{{0, 1, 2}};
        bodies.push_back(makeBody({mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]}, loops));
    }
    return bodies;
}

} // namespace antumbra::scene
