// A region is projected along its axis. Its normals keep it from folding over, but a spiral still comes round to lie on itself: there
// it is cut.
#include "bake/charts.h"

#include "bake/overlap.h"
#include "base/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace antumbra::bake {

namespace {

/// Two directions that span the plane across `axis`, right-handed with it (Duff et al. 2017).
std::array<vec3, 2> planeAcross(vec3 axis)
{
    const float sign = std::copysign(1.0f, axis.z);
    const float a = -1.0f / (sign + axis.z);
    const float b = axis.x * axis.y * a;
    return {vec3{1.0f + sign * axis.x * axis.x * a, sign * b, -sign * axis.x}, vec3{b, sign + axis.y * axis.y * a, -axis.y}};
}

float areaOf(const Surface& surface, uint32_t triangle)
{
    const uint32_t* corners = &surface.indices[size_t{3} * triangle];
    const vec3 a = surface.positions[corners[0]];
    return 0.5f * glm::length(glm::cross(surface.positions[corners[1]] - a, surface.positions[corners[2]] - a));
}

/// Counter-clockwise, without points on its edges (Andrew 1979).
std::vector<vec2> convexHull(std::vector<vec2> points)
{
    std::ranges::sort(points, [](vec2 a, vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<vec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const size_t start = hull.size();
        for (const vec2 point : points) {
            while (hull.size() >= start + 2 && twiceArea({hull[hull.size() - 2], hull.back(), point}) <= 0)
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back(); // the other half starts there
        std::ranges::reverse(points);
    }
    return hull;
}

struct TurnedBox
{
    vec2 right{1, 0}; // direction of its longer side, unit
    vec2 lowest{0};   // along right, and along what is left of it
    vec2 extent{0};
};

TurnedBox boxAlong(const std::vector<vec2>& hull, vec2 right)
{
    const vec2 up(-right.y, right.x);
    Rect box;
    for (const vec2 point : hull)
        box.add({glm::dot(point, right), glm::dot(point, up)});
    return {right, box.lowest, box.highest - box.lowest};
}

/// One edge of the hull lies on the smallest box (Freeman and Shapira 1975).
TurnedBox smallestBox(const std::vector<vec2>& hull)
{
    TurnedBox smallest;
    float smallestArea = std::numeric_limits<float>::infinity();
    for (size_t i = 0; i < hull.size(); ++i) {
        const vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const TurnedBox box = boxAlong(hull, glm::normalize(edge));
        if (const float area = box.extent.x * box.extent.y; area < smallestArea) {
            smallestArea = area;
            smallest = box;
        }
    }
    return smallest.extent.x < smallest.extent.y ? boxAlong(hull, {-smallest.right.y, smallest.right.x}) : smallest;
}

/// Cuts one region after the other into charts.
class Cutter
{
public:
    explicit Cutter(const Surface& surface)
        : surface_(surface), regions_(regionsOf(surface)), projected_(surface.triangleCount()), isCharted_(surface.triangleCount())
    {
    }

    std::vector<Chart> charts()
    {
        std::vector<Chart> charts;
        for (const Region& region : regions_.regions)
            cut(region, charts);
        return charts;
    }

private:
    struct Walk
    {
        std::vector<uint32_t> triangles;
        bool meetsItself = false;
    };

    /// Where a region meets itself, charts of half its turn are cut, so that their ends do not even come near each other.
    void cut(const Region& region, std::vector<Chart>& charts)
    {
        const Rect box = project(region);
        size_t most = region.triangles.size();
        for (const uint32_t first : region.triangles) {
            if (isCharted_[first])
                continue;
            Walk walk = walkFrom(first, box, most);
            if (walk.meetsItself && most == region.triangles.size()) {
                most = (walk.triangles.size() + 1) / 2;
                for (const uint32_t triangle : std::span(walk.triangles).subspan(most))
                    isCharted_[triangle] = 0;
                walk.triangles.resize(most);
            }
            charts.push_back(chartOf(std::move(walk.triangles)));
        }
    }

    Rect project(const Region& region)
    {
        const auto [u, v] = planeAcross(region.axis);
        Rect box;
        for (const uint32_t triangle : region.triangles)
            for (size_t corner = 0; corner < 3; ++corner) {
                const vec3 position = surface_.positions[surface_.indices[size_t{3} * triangle + corner]];
                projected_[triangle][corner] = {glm::dot(position, u), glm::dot(position, v)};
                box.add(projected_[triangle][corner]);
            }
        return box;
    }

    /// Breadth first over triangles of no chart yet, around those that would overlap; connected, wherever it ends.
    Walk walkFrom(uint32_t first, const Rect& box, size_t most)
    {
        FlatTriangles taken(box.lowest, box.highest, most);
        taken.add(projected_[first]);
        isCharted_[first] = 1;
        Walk walk{{first}};
        for (size_t i = 0; i < walk.triangles.size(); ++i)
            for (const uint32_t neighbour : regions_.neighbours.of(walk.triangles[i])) {
                if (isCharted_[neighbour] || walk.triangles.size() == most)
                    continue;
                if (!taken.add(projected_[neighbour])) {
                    walk.meetsItself = true;
                    continue;
                }
                isCharted_[neighbour] = 1;
                walk.triangles.push_back(neighbour);
            }
        return walk;
    }

    Chart chartOf(std::vector<uint32_t> triangles) const
    {
        Chart chart{std::move(triangles), {}};
        for (const uint32_t triangle : chart.triangles)
            chart.corners.insert(chart.corners.end(), projected_[triangle].begin(), projected_[triangle].end());
        scaleToSurface(chart, surface_);
        layInBox(chart);
        return chart;
    }

    const Surface& surface_;
    const Regions regions_;
    std::vector<FlatTriangle> projected_; // one a triangle, on the plane of its region
    std::vector<uint8_t> isCharted_;
};

} // namespace

void scaleToSurface(Chart& chart, const Surface& surface)
{
    double areaThere = 0;
    double areaHere = 0;
    for (size_t i = 0; i < chart.triangles.size(); ++i) {
        areaThere += areaOf(surface, chart.triangles[i]);
        areaHere += 0.5 * std::abs(twiceArea({chart.corners[3 * i], chart.corners[3 * i + 1], chart.corners[3 * i + 2]}));
    }
    if (!(areaHere > 0))
        return;
    for (vec2& corner : chart.corners)
        corner *= static_cast<float>(std::sqrt(areaThere / areaHere));
}

void layInBox(Chart& chart)
{
    const TurnedBox box = smallestBox(convexHull(chart.corners));
    const vec2 up(-box.right.y, box.right.x);
    for (vec2& corner : chart.corners)
        corner = glm::clamp(vec2(glm::dot(corner, box.right), glm::dot(corner, up)) - box.lowest, vec2(0), box.extent);
    chart.extent = box.extent;
}

std::vector<Chart> chartsOf(const Surface& surface) { return Cutter(surface).charts(); }

} // namespace antumbra::bake
