#include "scene/merged_body.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <utility>

namespace antumbra::scene {

namespace {

constexpr double kShareOfExtent = 1e-6;
constexpr double kShareOfPlace = 4 * 0x1p-24; // four roundings to float
constexpr double kSameFace = 4;               // times roundingOf(): as far off a face's plane its own corners may be
constexpr double kSameSurface = 8;            // and in front of it all others
constexpr uint32_t kNoRegion = ~0u;

double farthestCoordinate(std::span<const vec3> points)
{
    float farthest = 0;
    for (const vec3& point : points)
        farthest = std::max({farthest, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    return farthest;
}

/// The plane of one face or several, by their areas.
struct Plane
{
    glm::dvec3 twiceArea{0}; // along the normal
    glm::dvec3 moment{0};    // middle times twice the area
    double weight = 0;       // sum of the parts' twice the area
    double length = 0;       // of the longest edge

    void add(std::span<const uint32_t> loop, std::span<const vec3> vertices)
    {
        const glm::dvec3 origin(vertices[loop[0]]);
        for (size_t i = 1; i + 1 < loop.size(); ++i) {
            const glm::dvec3 a(vertices[loop[i]]);
            const glm::dvec3 b(vertices[loop[i + 1]]);
            const glm::dvec3 part = glm::cross(a - origin, b - origin);
            twiceArea += part;
            moment += glm::length(part) / 3 * (origin + a + b);
            weight += glm::length(part);
        }
        for (size_t i = 0; i < loop.size(); ++i)
            length = std::max(length, glm::distance(glm::dvec3(vertices[loop[i]]), glm::dvec3(vertices[loop[(i + 1) % loop.size()]])));
    }
    [[nodiscard]] double area() const { return 0.5 * glm::length(twiceArea); }
    [[nodiscard]] double width() const { return area() / length; } // how short a base the normal rests on
    [[nodiscard]] glm::dvec3 fromMiddle(vec3 point) const { return glm::dvec3(point) - moment / weight; }
    [[nodiscard]] double height(vec3 point) const { return glm::dot(fromMiddle(point), glm::normalize(twiceArea)); }
};

std::vector<Plane> planesOf(const ConvexBody& body)
{
    std::vector<Plane> planes(body.faces.size());
    for (uint32_t face = 0; face < planes.size(); ++face)
        planes[face].add(body.loop(face), body.vertices);
    return planes;
}

std::vector<std::vector<uint32_t>> neighboursOf(const ConvexBody& body)
{
    std::vector<std::vector<uint32_t>> neighbours(body.faces.size());
    for (const ConvexBody::Edge& edge : body.edges) {
        neighbours[edge.left].push_back(edge.right);
        neighbours[edge.right].push_back(edge.left);
    }
    return neighbours;
}

/// Which faces belong together, as numbers of regions. From the greatest face on, a region takes in the faces next to it whose
/// corners lie on its plane, which is that of all faces it has so far.
std::vector<uint32_t> regionsOf(const ConvexBody& body, double rounding)
{
    const std::vector<Plane> planes = planesOf(body);
    const std::vector<std::vector<uint32_t>> neighbours = neighboursOf(body);
    std::vector<uint32_t> greatestFirst(body.faces.size());
    std::iota(greatestFirst.begin(), greatestFirst.end(), 0u);
    std::ranges::stable_sort(greatestFirst, [&](uint32_t a, uint32_t b) { return planes[a].area() > planes[b].area(); });

    std::vector<uint32_t> regions(body.faces.size(), kNoRegion);
    for (const uint32_t seed : greatestFirst) {
        if (regions[seed] != kNoRegion || planes[seed].area() == 0)
            continue;
        Plane plane = planes[seed];
        const auto isOnPlane = [&](uint32_t corner) { return std::abs(plane.height(body.vertices[corner])) <= kSameFace * rounding; };
        regions[seed] = seed;
        std::deque<uint32_t> front{seed};
        for (; !front.empty(); front.pop_front())
            for (const uint32_t next : neighbours[front.front()])
                if (regions[next] == kNoRegion && std::ranges::all_of(body.loop(next), isOnPlane)) {
                    regions[next] = seed;
                    plane.add(body.loop(next), body.vertices);
                    front.push_back(next);
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

/// In one piece without holes (Euler), and every point behind every face.
bool isConvex(const ConvexBody& body, std::span<const vec3> points, Corners corners)
{
    if (!isClosed(body) || body.vertices.size() + body.faces.size() != body.edges.size() + 2)
        return false;
    const double rounding = roundingOf(points);
    const double placeError = corners == Corners::Exact ? 0 : kShareOfPlace * farthestCoordinate(points);
    return std::ranges::all_of(planesOf(body), [&](const Plane& plane) {
        if (plane.width() <= placeError)
            return false;
        const double turn = placeError / plane.width();
        return std::ranges::all_of(points, [&](vec3 point) {
            return plane.height(point) <= kSameSurface * rounding + turn * glm::length(plane.fromMiddle(point));
        });
    });
}

std::optional<ConvexBody> withMergedFaces(const ConvexBody& split)
{
    const std::vector<uint32_t> regions = regionsOf(split, roundingOf(split.vertices));
    if (std::ranges::find(regions, kNoRegion) != regions.end())
        return std::nullopt;
    const std::optional<Borders> borders = bordersOf(split, regions);
    if (!borders)
        return std::nullopt;
    std::optional<std::vector<Loop>> loops = loopsOf(*borders, split.vertices.size());
    if (!loops)
        return std::nullopt;
    std::vector<vec3> vertices = takeUsed(split.vertices, *loops);
    return linkedBody(std::move(vertices), *loops);
}

} // namespace

double roundingOf(std::span<const vec3> points)
{
    Aabb box;
    for (const vec3& point : points)
        box.add(point);
    if (points.empty())
        return 0;
    const glm::dvec3 extent = glm::dvec3(box.highest) - glm::dvec3(box.lowest);
    return std::max(kShareOfExtent * std::max({extent.x, extent.y, extent.z}), kShareOfPlace * farthestCoordinate(points));
}

std::optional<ConvexBody> mergedBody(std::span<const vec3> vertices, std::span<const Loop> loops, Corners corners)
{
    std::vector<Loop> renumbered(loops.begin(), loops.end());
    std::vector<vec3> used = takeUsed(vertices, renumbered);
    std::optional<ConvexBody> split = linkedBody(std::move(used), renumbered);
    if (!split || !isClosed(*split))
        return std::nullopt;
    std::optional<ConvexBody> merged = withMergedFaces(*split);
    if (merged && isConvex(*merged, split->vertices, corners))
        return merged;
    if (isConvex(*split, split->vertices, corners))
        return split;
    return std::nullopt;
}

} // namespace antumbra::scene
