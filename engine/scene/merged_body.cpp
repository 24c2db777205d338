#include "scene/merged_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace antumbra::scene {

namespace {

constexpr double kShareOfExtent = 1e-6;
constexpr double kShareOfPlace = 4 * 0x1p-24; // four roundings to float
constexpr uint32_t kNoRegion = ~0u;

struct Plane
{
    glm::dvec3 middle{0};
    glm::dvec3 normal{0};
    double area = 0;
    double width = 0; // area over longest edge: how short a base the normal rests on
};

Plane planeOf(const ConvexBody& body, uint32_t face, const glm::dvec3& normal)
{
    Plane plane{.normal = normal};
    const std::span<const uint32_t> loop = body.loop(face);
    const glm::dvec3 origin(body.vertices[loop[0]]);
    double longest = 0;
    for (size_t i = 0; i < loop.size(); ++i) {
        const glm::dvec3 a = glm::dvec3(body.vertices[loop[i]]) - origin;
        const glm::dvec3 b = glm::dvec3(body.vertices[loop[(i + 1) % loop.size()]]) - origin;
        plane.middle += a / static_cast<double>(loop.size());
        plane.area += 0.5 * glm::dot(glm::cross(a, b), normal);
        longest = std::max(longest, glm::length(b - a));
    }
    plane.middle += origin;
    plane.width = longest > 0 ? plane.area / longest : 0;
    return plane;
}

std::vector<Plane> planesOf(const ConvexBody& body)
{
    const std::vector<glm::dvec3> normals = faceNormals(body);
    std::vector<Plane> planes;
    planes.reserve(normals.size());
    for (uint32_t face = 0; face < normals.size(); ++face)
        planes.push_back(planeOf(body, face, normals[face]));
    return planes;
}

double height(const Plane& plane, vec3 point) { return glm::dot(glm::dvec3(point) - plane.middle, plane.normal); }

/// How far a point may lie off the plane and still be on it.
double slack(const Plane& plane, vec3 point, double rounding)
{
    const double reach = glm::length(glm::dvec3(point) - plane.middle);
    return rounding * (1 + (plane.width > 0 ? reach / plane.width : 0));
}

/// Which faces belong together, as numbers of regions: those next to each other all of whose corners lie on one plane, that of the
/// greatest of them.
std::vector<uint32_t> regionsOf(const ConvexBody& body, const std::vector<Plane>& planes, double rounding)
{
    std::vector<std::vector<uint32_t>> neighbours(body.faces.size());
    for (const ConvexBody::Edge& edge : body.edges) {
        neighbours[edge.left].push_back(edge.right);
        neighbours[edge.right].push_back(edge.left);
    }
    std::vector<uint32_t> greatestFirst(body.faces.size());
    std::iota(greatestFirst.begin(), greatestFirst.end(), 0u);
    std::ranges::stable_sort(greatestFirst, [&](uint32_t a, uint32_t b) { return planes[a].area > planes[b].area; });

    std::vector<uint32_t> regions(body.faces.size(), kNoRegion);
    for (const uint32_t seed : greatestFirst) {
        if (regions[seed] != kNoRegion)
            continue;
        const auto isOnPlane = [&](uint32_t corner) {
            const vec3 vertex = body.vertices[corner];
            return std::abs(height(planes[seed], vertex)) <= slack(planes[seed], vertex, rounding);
        };
        regions[seed] = seed;
        for (std::vector<uint32_t> front{seed}; !front.empty();) {
            const uint32_t face = front.back();
            front.pop_back();
            for (const uint32_t next : neighbours[face])
                if (regions[next] == kNoRegion && std::ranges::all_of(body.loop(next), isOnPlane)) {
                    regions[next] = seed;
                    front.push_back(next);
                }
        }
    }
    return regions;
}

/// {region, vertex} -> the vertex after it on the region's border.
using Borders = std::map<std::pair<uint32_t, uint32_t>, uint32_t>;

std::optional<Borders> bordersOf(const ConvexBody& body, const std::vector<uint32_t>& regions)
{
    Borders borders;
    bool isSimple = true;
    for (const ConvexBody::Edge& edge : body.edges)
        if (regions[edge.left] != regions[edge.right]) {
            isSimple = borders.insert({{regions[edge.left], edge.a}, edge.b}).second && isSimple;
            isSimple = borders.insert({{regions[edge.right], edge.b}, edge.a}).second && isSimple;
        }
    if (!isSimple)
        return std::nullopt;
    return borders;
}

/// One loop a region, nothing where one has several. A vertex between two regions alone lies on the line where they meet: left out.
std::optional<std::vector<Loop>> loopsOf(const Borders& borders, size_t vertexCount)
{
    std::vector<uint32_t> regionsAt(vertexCount, 0);
    for (const auto& [from, to] : borders)
        ++regionsAt[from.second];
    std::vector<Loop> loops;
    for (auto first = borders.begin(); first != borders.end();) {
        const uint32_t region = first->first.first;
        const auto end = borders.lower_bound({region + 1, 0});
        Loop loop;
        std::ptrdiff_t length = 0;
        uint32_t vertex = first->first.second;
        do {
            if (regionsAt[vertex] >= 3)
                loop.push_back(vertex);
            vertex = borders.at({region, vertex});
            ++length;
        } while (vertex != first->first.second);
        if (length != std::distance(first, end))
            return std::nullopt;
        if (loop.size() >= 3)
            loops.push_back(std::move(loop));
        first = end;
    }
    return loops;
}

/// The vertices that the loops use, in their old order; the loops are renumbered.
std::vector<vec3> takeUsed(std::span<const vec3> vertices, std::vector<Loop>& loops)
{
    std::vector<uint32_t> places(vertices.size(), kNoIndex);
    for (const Loop& loop : loops)
        for (const uint32_t corner : loop)
            places[corner] = 0;
    std::vector<vec3> used;
    for (size_t i = 0; i < vertices.size(); ++i)
        if (places[i] != kNoIndex) {
            places[i] = static_cast<uint32_t>(used.size());
            used.push_back(vertices[i]);
        }
    for (Loop& loop : loops)
        for (uint32_t& corner : loop)
            corner = places[corner];
    return used;
}

/// In one piece without holes (Euler), and every vertex behind every face.
bool isConvex(const ConvexBody& body, double rounding)
{
    if (body.vertices.size() + body.faces.size() != body.edges.size() + 2)
        return false;
    const std::vector<Plane> planes = planesOf(body);
    return std::ranges::all_of(planes, [&](const Plane& plane) {
        return std::ranges::all_of(body.vertices, [&](vec3 vertex) { return height(plane, vertex) <= slack(plane, vertex, rounding); });
    });
}

} // namespace

double roundingOf(std::span<const vec3> points)
{
    Aabb box;
    float farthest = 0;
    for (const vec3& point : points) {
        box.add(point);
        farthest = std::max({farthest, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    }
    if (points.empty())
        return 0;
    const glm::dvec3 extent = glm::dvec3(box.highest) - glm::dvec3(box.lowest);
    return std::max(kShareOfExtent * std::max({extent.x, extent.y, extent.z}), kShareOfPlace * farthest);
}

std::optional<ConvexBody> mergedBody(std::span<const vec3> vertices, std::span<const Loop> loops, double rounding)
{
    const std::optional<ConvexBody> split = linkedBody({vertices.begin(), vertices.end()}, loops);
    if (!split || !isClosed(*split))
        return std::nullopt;
    const std::vector<uint32_t> regions = regionsOf(*split, planesOf(*split), rounding);
    const std::optional<Borders> borders = bordersOf(*split, regions);
    if (!borders)
        return std::nullopt;
    std::optional<std::vector<Loop>> merged = loopsOf(*borders, vertices.size());
    if (!merged)
        return std::nullopt;
    std::vector<vec3> used = takeUsed(vertices, *merged);
    std::optional<ConvexBody> body = linkedBody(std::move(used), *merged);
    if (!body || !isClosed(*body) || !isConvex(*body, rounding))
        return std::nullopt;
    return body;
}

} // namespace antumbra::scene
