// The flattest edge is joined first, as long as a cone of kRegionHalfAngle holds all normals.
#include "bake/regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace antumbra::bake {

namespace {

constexpr float kSharpestCrease = 50 * kPi / 180; // light changes too much across sharper ones
constexpr float kCreaseUnit = 1.0f / 256;         // radians; creases that differ by less are equal

/// Two triangles that run along a common edge in opposite directions.
struct Link
{
    uint32_t a, b;
    uint32_t crease; // angle between the normals, kCreaseUnit
};

/// Directions within halfAngle (radians) of the axis.
struct Cone
{
    vec3 axis;
    float halfAngle = 0;
};

float angleBetween(vec3 a, vec3 b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

/// The narrowest cone that holds both.
Cone coneAround(const Cone& a, const Cone& b)
{
    const float between = angleBetween(a.axis, b.axis);
    if (between + b.halfAngle <= a.halfAngle)
        return a;
    if (between + a.halfAngle <= b.halfAngle)
        return b;
    const float halfAngle = 0.5f * (a.halfAngle + b.halfAngle + between);
    const float turn = halfAngle - a.halfAngle;
    const vec3 axis = std::sin(between - turn) * a.axis + std::sin(turn) * b.axis;
    return {glm::length(axis) > 0 ? glm::normalize(axis) : a.axis, halfAngle};
}

struct EdgeUse
{
    uint64_t edge; // the lower vertex, then the higher
    uint32_t triangle;
    bool isForward; // from the lower vertex to the higher
};

std::vector<EdgeUse> edgeUsesOf(const Surface& surface)
{
    std::vector<EdgeUse> uses;
    uses.reserve(surface.indices.size());
    for (uint32_t i = 0; i < surface.indices.size(); ++i) {
        const uint32_t from = surface.indices[i], to = surface.indices[i % 3 == 2 ? i - 2 : i + 1];
        uses.push_back({uint64_t{std::min(from, to)} << 32 | std::max(from, to), i / 3, from < to});
    }
    std::ranges::sort(uses, [](const EdgeUse& a, const EdgeUse& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.isForward != b.isForward ? a.isForward : a.triangle < b.triangle;
    });
    return uses;
}

/// Over all edges but the sharp ones, the flattest first. Where more than two triangles meet at an edge, each that runs forward takes the
/// flattest that runs backward.
std::vector<Link> linksOf(const Surface& surface, const std::vector<vec3>& normals)
{
    const std::vector<EdgeUse> uses = edgeUsesOf(surface);
    std::vector<Link> links;
    links.reserve(uses.size() / 2);
    for (size_t first = 0, backward = 0, last = 0; first < uses.size(); first = last) {
        for (last = first; last < uses.size() && uses[last].edge == uses[first].edge; ++last)
            backward = uses[last].isForward ? last + 1 : std::max(backward, first);
        for (size_t i = first; i < backward && backward < last; ++i) {
            const vec3 normal = normals[uses[i].triangle];
            const auto flattest = std::max_element(&uses[backward], &uses[0] + last, [&](const EdgeUse& a, const EdgeUse& b) {
                return glm::dot(normal, normals[a.triangle]) < glm::dot(normal, normals[b.triangle]);
            });
            const float crease = angleBetween(normal, normals[flattest->triangle]);
            if (crease <= kSharpestCrease)
                links.push_back({uses[i].triangle, flattest->triangle, static_cast<uint32_t>(crease / kCreaseUnit)});
        }
    }
    std::ranges::sort(links, [](const Link& a, const Link& b) {
        return a.crease != b.crease ? a.crease < b.crease : a.a != b.a ? a.a < b.a : a.b < b.b;
    });
    return links;
}

/// Disjoint sets of triangles, each with the cone of its normals.
class DisjointRegions
{
public:
    explicit DisjointRegions(const std::vector<vec3>& normals) : parents_(normals.size()), cones_(normals.size())
    {
        std::iota(parents_.begin(), parents_.end(), 0u);
        std::ranges::transform(normals, cones_.begin(), [](vec3 normal) { return Cone{normal}; });
    }

    uint32_t regionOf(uint32_t triangle)
    {
        while (parents_[triangle] != triangle)
            triangle = parents_[triangle] = parents_[parents_[triangle]];
        return triangle;
    }

    void joinWhereFlat(const Link& link)
    {
        const uint32_t a = regionOf(link.a), b = regionOf(link.b);
        if (a == b)
            return;
        const Cone cone = coneAround(cones_[a], cones_[b]);
        if (cone.halfAngle > kRegionHalfAngle)
            return;
        parents_[std::max(a, b)] = std::min(a, b);
        cones_[std::min(a, b)] = cone;
    }

    [[nodiscard]] vec3 axisOf(uint32_t region) const { return cones_[region].axis; }

private:
    std::vector<uint32_t> parents_;
    std::vector<Cone> cones_;
};

Neighbours neighboursBy(const std::vector<Link>& links, size_t triangleCount)
{
    Neighbours neighbours{std::vector<uint32_t>(triangleCount + 1), std::vector<uint32_t>(2 * links.size())};
    for (const Link& link : links)
        for (const uint32_t triangle : {link.a, link.b})
            ++neighbours.firsts[triangle + 1];
    std::partial_sum(neighbours.firsts.begin(), neighbours.firsts.end(), neighbours.firsts.begin());
    std::vector<uint32_t> ends(neighbours.firsts.begin(), neighbours.firsts.end() - 1);
    for (const Link& link : links) {
        neighbours.triangles[ends[link.a]++] = link.b;
        neighbours.triangles[ends[link.b]++] = link.a;
    }
    return neighbours;
}

/// The sets in the order of their first triangles.
std::vector<Region> regionsBy(DisjointRegions& joined, size_t triangleCount)
{
    std::vector<Region> regions;
    std::vector<size_t> places(triangleCount);
    for (uint32_t triangle = 0; triangle < triangleCount; ++triangle) {
        const uint32_t first = joined.regionOf(triangle);
        if (first == triangle) {
            places[first] = regions.size();
            regions.push_back({joined.axisOf(first), {}});
        }
        regions[places[first]].triangles.push_back(triangle);
    }
    return regions;
}

} // namespace

vec3 normalOf(const Surface& surface, uint32_t triangle)
{
    const uint32_t* corners = &surface.indices[size_t{3} * triangle];
    const vec3 a = surface.positions[corners[0]];
    const glm::dvec3 normal = glm::cross(glm::dvec3(surface.positions[corners[1]] - a), glm::dvec3(surface.positions[corners[2]] - a));
    return vec3(glm::normalize(normal));
}

Regions regionsOf(const Surface& surface)
{
    std::vector<vec3> normals(surface.triangleCount());
    for (uint32_t triangle = 0; triangle < normals.size(); ++triangle)
        normals[triangle] = normalOf(surface, triangle);
    std::vector<Link> links = linksOf(surface, normals);
    DisjointRegions joined(normals);
    for (const Link& link : links)
        joined.joinWhereFlat(link);
    std::erase_if(links, [&](const Link& link) { return joined.regionOf(link.a) != joined.regionOf(link.b); });
    return {regionsBy(joined, normals.size()), neighboursBy(links, normals.size())};
}

} // namespace antumbra::bake
