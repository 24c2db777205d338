#include "bake/simplified_hull.h"

#include "bake/qhull.h"
#include "bake/spread.h"
#include "base/check.h"

#include <algorithm>
#include <cmath>

namespace antumbra::bake {

namespace {

using scene::ConvexBody;
using scene::Loop;

constexpr uint32_t kMostChosen = 128;    // the time goes with the square
constexpr int kMostExchanges = 4;        // of every vertex
constexpr double kLeastThickness = 1e-7; // of what Qhull is given, at an extent of about one

/// Twice the area, along the normal.
glm::dvec3 twiceAreaOf(const Loop& loop, std::span<const glm::dvec3> points)
{
    glm::dvec3 sum(0);
    for (size_t i = 1; i + 1 < loop.size(); ++i)
        sum += glm::cross(points[loop[i]] - points[loop[0]], points[loop[i + 1]] - points[loop[0]]);
    return sum;
}

/// The hull of the chosen points, as what one point more would add to its volume.
class Volume
{
public:
    Volume(std::span<const glm::dvec3> points, const std::vector<uint32_t>& chosen)
    {
        std::vector<glm::dvec3> corners;
        for (const uint32_t point : chosen)
            corners.push_back(points[point]);
        for (const Loop& loop : hullLoops(corners)) {
            const glm::dvec3 normal = twiceAreaOf(loop, corners) / 6.0;
            facets_.push_back({normal, glm::dot(normal, corners[loop[0]])});
        }
    }

    [[nodiscard]] double gain(const glm::dvec3& point) const
    {
        double sum = 0;
        for (const Facet& facet : facets_)
            sum += std::max(0.0, glm::dot(facet.normal, point) - facet.offset);
        return sum;
    }

    /// The point, not chosen, that adds most; `otherwise` where none adds more than that one.
    [[nodiscard]] uint32_t best(std::span<const glm::dvec3> points, const std::vector<uint32_t>& chosen, uint32_t otherwise) const
    {
        constexpr double kWorthwhile = 1e-9; // of a volume of about one
        uint32_t result = otherwise;
        double greatest = (otherwise == scene::kNoIndex ? 0 : gain(points[otherwise])) + kWorthwhile;
        for (uint32_t point = 0; point < points.size(); ++point) {
            const double here = gain(points[point]);
            if (here > greatest && std::ranges::find(chosen, point) == chosen.end()) {
                greatest = here;
                result = point;
            }
        }
        return result;
    }

private:
    struct Facet
    {
        glm::dvec3 normal; // as long as a third of the area
        double offset = 0;
    };
    std::vector<Facet> facets_;
};

std::vector<uint32_t> chooseVertices(std::span<const glm::dvec3> points, uint32_t count)
{
    const Spread spread = spreadOf(points, 0);
    check(spread.dimensions == 3, "a closed body spans space");
    std::vector<uint32_t> chosen(spread.corners.begin(), spread.corners.end());
    while (chosen.size() < count) {
        const uint32_t next = Volume(points, chosen).best(points, chosen, scene::kNoIndex);
        if (next == scene::kNoIndex)
            break;
        chosen.push_back(next);
    }
    return chosen;
}

bool spanSpace(std::span<const glm::dvec3> points, const std::vector<uint32_t>& chosen)
{
    std::vector<glm::dvec3> corners;
    for (const uint32_t point : chosen)
        corners.push_back(points[point]);
    return spreadOf(corners, kLeastThickness).dimensions == 3;
}

/// Exchanges one vertex after another for the point that adds most to the hull of the others, where the others have one.
void exchangeVertices(std::span<const glm::dvec3> points, std::vector<uint32_t>& chosen)
{
    bool hasChanged = chosen.size() > 4;
    for (int i = 0; i < kMostExchanges && hasChanged; ++i) {
        hasChanged = false;
        for (uint32_t& vertex : chosen) {
            std::vector<uint32_t> others;
            std::ranges::copy_if(chosen, std::back_inserter(others), [&](uint32_t other) { return other != vertex; });
            if (!spanSpace(points, others))
                continue;
            const uint32_t best = Volume(points, others).best(points, others, vertex);
            hasChanged = hasChanged || best != vertex;
            vertex = best;
        }
    }
}

/// The middle of the surface.
glm::dvec3 middleOf(const ConvexBody& body)
{
    glm::dvec3 sum(0);
    double area = 0;
    const glm::dvec3 origin(body.vertices[0]);
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const std::span<const uint32_t> loop = body.loop(face);
        const auto corner = [&](size_t i) { return glm::dvec3(body.vertices[loop[i]]) - origin; };
        for (size_t i = 1; i + 1 < loop.size(); ++i) {
            const double twiceArea = glm::length(glm::cross(corner(i) - corner(0), corner(i + 1) - corner(0)));
            sum += twiceArea / 3 * (corner(0) + corner(i) + corner(i + 1));
            area += twiceArea;
        }
    }
    return origin + sum / area;
}

ConvexBody fewerVertices(const ConvexBody& full, uint32_t count)
{
    const std::vector<glm::dvec3> points = atUnitExtent(full.vertices);
    std::vector<uint32_t> chosen = chooseVertices(points, count);
    exchangeVertices(points, chosen);
    std::vector<vec3> vertices;
    for (const uint32_t vertex : chosen)
        vertices.push_back(full.vertices[vertex]);
    return solidHull(vertices);
}

/// Leaves out one corner after another, always the one that costs least area.
ConvexBody fewerCorners(const ConvexBody& full, uint32_t count)
{
    std::vector<vec3> corners;
    for (const uint32_t corner : full.loop(0))
        corners.push_back(full.vertices[corner]);
    while (corners.size() > count) {
        const size_t size = corners.size();
        const auto loss = [&](size_t i) {
            const glm::dvec3 corner(corners[i]);
            return glm::length(
                glm::cross(glm::dvec3(corners[(i + 1) % size]) - corner, glm::dvec3(corners[(i + size - 1) % size]) - corner));
        };
        size_t least = 0;
        for (size_t i = 1; i < size; ++i)
            if (loss(i) < loss(least))
                least = i;
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(least));
    }
    std::vector<Loop> loops(1);
    for (uint32_t i = 0; i < corners.size(); ++i)
        loops[0].push_back(i);
    return scene::makeBody(std::move(corners), loops);
}

} // namespace

ConvexBody simplifiedHull(const ConvexBody& full, uint32_t greatestVertices)
{
    const uint32_t count = std::min(greatestVertices, kMostChosen);
    ConvexBody body = full.isPlanar ? fewerCorners(full, count) : fewerVertices(full, count);
    const double scale = std::sqrt(surfaceArea(full) / surfaceArea(body));
    const glm::dvec3 from = middleOf(body);
    const glm::dvec3 to = middleOf(full);
    for (vec3& vertex : body.vertices)
        vertex = vec3(to + scale * (glm::dvec3(vertex) - from));
    return body;
}

} // namespace antumbra::bake
