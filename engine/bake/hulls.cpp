#include "bake/hulls.h"

#include "bake/qhull.h"
#include "bake/simplified_hull.h"
#include "bake/spread.h"
#include "base/check.h"
#include "base/error.h"
#include "scene/merged_body.h"
#include "scene/mesh_pieces.h"
#include "scene/outline.h"
#include "scene/triangle_joints.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace antumbra::bake {

namespace {

using scene::ConvexBody;
using scene::Loop;

constexpr float kGreatestCoordinate = 1e30f; // metres
constexpr double kLeastExtent = 1e-30;
constexpr double kFlat = 4; // times what rounding may move a point

/// The outline of points that lie in the plane of the first three corners.
std::optional<ConvexBody> flatHull(std::span<const vec3> points, std::span<const glm::dvec3> atUnit, const Spread& spread)
{
    const glm::dvec3 origin = atUnit[spread.corners[0]];
    const glm::dvec3 u = glm::normalize(atUnit[spread.corners[1]] - origin);
    const glm::dvec3 normal = glm::normalize(glm::cross(u, atUnit[spread.corners[2]] - origin));
    const glm::dvec3 v = glm::cross(normal, u);
    std::vector<glm::dvec2> places;
    places.reserve(atUnit.size());
    for (const glm::dvec3& point : atUnit)
        places.emplace_back(glm::dot(point - origin, u), glm::dot(point - origin, v));
    std::vector<vec3> vertices;
    std::vector<Loop> loops(1);
    for (const uint32_t corner : scene::outlineOf(places)) {
        loops[0].push_back(static_cast<uint32_t>(vertices.size()));
        vertices.push_back(points[corner]);
    }
    if (vertices.size() < 3)
        return std::nullopt;
    return scene::makeBody(std::move(vertices), loops);
}

std::optional<ConvexBody> fullHull(std::span<const vec3> points)
{
    const double rounding = scene::roundingOf(points);
    Aabb box;
    for (const vec3& point : points)
        box.add(point);
    const vec3 extent = box.extent();
    const double greatest = std::max({extent.x, extent.y, extent.z});
    if (greatest < kLeastExtent)
        return std::nullopt;
    const std::vector<glm::dvec3> atUnit = atUnitExtent(points);
    const Spread spread = spreadOf(atUnit, kFlat * rounding / greatest);
    if (spread.dimensions < 2)
        return std::nullopt;
    if (spread.dimensions == 2)
        return flatHull(points, atUnit, spread);
    return solidHull(points);
}

std::map<uint32_t, std::vector<uint32_t>> byPiece(const std::vector<uint32_t>& vertices, const std::vector<uint32_t>& pieces)
{
    std::map<uint32_t, std::vector<uint32_t>> split;
    for (const uint32_t vertex : vertices)
        split[pieces[vertex]].push_back(vertex);
    return split;
}

} // namespace

std::optional<ConvexBody> convexHull(std::span<const vec3> points, uint32_t greatestVertices)
{
    check(greatestVertices >= 4, "a hull has four vertices");
    const auto isWithin = [](float x) { return std::abs(x) <= kGreatestCoordinate; };
    if (!std::ranges::all_of(points, [&](vec3 p) { return isWithin(p.x) && isWithin(p.y) && isWithin(p.z); }))
        throw Error("a coordinate is not finite or beyond 1e30 m", "convex hull");
    std::optional<ConvexBody> body = fullHull(points);
    if (!body || body->vertices.size() <= greatestVertices)
        return body;
    return simplifiedHull(*body, greatestVertices);
}

std::vector<Hull> hullsOfModel(const scene::Model& model, uint32_t greatestVertices, HullsBy by)
try {
    const std::vector<uint32_t> pieces =
        by == HullsBy::Piece ? scene::piecesOf(model.mesh) : std::vector<uint32_t>(model.mesh.positions.size());
    std::vector<Hull> hulls;
    for (const auto& [joint, all] : scene::verticesByJoint(model.mesh))
        for (auto& [piece, vertices] : byPiece(all, pieces)) {
            std::vector<vec3> points;
            for (const uint32_t vertex : vertices)
                points.push_back(model.mesh.positions[vertex]);
            if (std::optional<ConvexBody> body = convexHull(points, greatestVertices))
                hulls.push_back({*std::move(body), joint, std::move(vertices)});
        }
    return hulls;
} catch (const Error& error) {
    throw Error(error.what(), model.name);
}

} // namespace antumbra::bake
