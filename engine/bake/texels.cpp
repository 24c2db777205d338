#include "bake/texels.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace antumbra::bake {

namespace {

constexpr uint32_t kNoTriangle = ~0u;

float crossed(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

/// A triangle on the page, in texels.
struct PageTriangle
{
    uint32_t index;
    std::array<vec2, 3> corners;
    float doubleArea; // signed

    [[nodiscard]] vec2 barycentric(vec2 p) const
    {
        const vec2 to = p - corners[0], ab = corners[1] - corners[0], ac = corners[2] - corners[0];
        return vec2(crossed(to, ac), crossed(ab, to)) / doubleArea;
    }
};

bool isInside(vec2 barycentric) { return barycentric.x >= 0 && barycentric.y >= 0 && barycentric.x + barycentric.y <= 1; }

/// A point that rounding puts outside of its triangle comes back to the rim.
SurfacePoint onTriangle(uint32_t triangle, vec2 barycentric)
{
    const vec2 inside = glm::max(barycentric, vec2(0));
    return {triangle, inside / std::max(inside.x + inside.y, 1.0f)};
}

/// What of a convex polygon lies within a square: a triangle cut four times has seven corners at most.
struct Polygon
{
    std::array<vec2, 8> corners;
    uint32_t count = 0;

    void add(vec2 corner) { corners[count++] = corner; }
};

/// Keeps the side where sign * (coordinate - limit) <= 0.
Polygon clipped(const Polygon& polygon, uint32_t axis, float limit, float sign)
{
    const int i = static_cast<int>(axis);
    Polygon result;
    for (uint32_t k = 0; k < polygon.count; ++k) {
        const vec2 a = polygon.corners[k], b = polygon.corners[(k + 1) % polygon.count];
        const float beyondA = sign * (a[i] - limit), beyondB = sign * (b[i] - limit);
        if (beyondA <= 0)
            result.add(a);
        if ((beyondA < 0 && beyondB > 0) || (beyondA > 0 && beyondB < 0))
            result.add(a + (b - a) * (beyondA / (beyondA - beyondB)));
    }
    return result;
}

Polygon partInTexel(const PageTriangle& triangle, uvec2 texel)
{
    Polygon polygon;
    for (const vec2 corner : triangle.corners)
        polygon.add(corner - vec2(texel));
    for (const uint32_t axis : {0u, 1u}) {
        polygon = clipped(polygon, axis, 0.0f, -1.0f);
        polygon = clipped(polygon, axis, 1.0f, 1.0f);
    }
    for (uint32_t k = 0; k < polygon.count; ++k)
        polygon.corners[k] += vec2(texel);
    return polygon;
}

float areaOf(const Polygon& polygon)
{
    float doubleArea = 0;
    for (uint32_t k = 2; k < polygon.count; ++k)
        doubleArea += crossed(polygon.corners[k - 1] - polygon.corners[0], polygon.corners[k] - polygon.corners[0]);
    return 0.5f * std::abs(doubleArea);
}

vec2 middleOf(const Polygon& polygon)
{
    vec2 sum{0};
    for (uint32_t k = 0; k < polygon.count; ++k)
        sum += polygon.corners[k];
    return sum / static_cast<float>(polygon.count);
}

/// Offsets within a texel: the additive recurrence of the plastic number, evenly spread for every count.
std::vector<vec2> patternOf(uint32_t count)
{
    std::vector<vec2> pattern;
    for (uint32_t i = 0; i < count; ++i)
        pattern.push_back(glm::fract(vec2(0.5f) + static_cast<float>(i) * vec2(0.7548776662f, 0.5698402910f)));
    return pattern;
}

/// For every place of the page, the surface at each offset of the pattern, and where the greatest part of a triangle lies, for places that
/// no offset finds.
class Coverage
{
public:
    Coverage(uvec2 extent, uint32_t mostPoints)
        : extent_(extent), pattern_(patternOf(mostPoints)), found_(size_t{extent.x} * extent.y * mostPoints, SurfacePoint{kNoTriangle, {}}),
          greatest_(size_t{extent.x} * extent.y)
    {
    }

    void add(const PageTriangle& triangle)
    {
        const auto& [a, b, c] = triangle.corners;
        const vec2 last = vec2(extent_) - 1.0f;
        const uvec2 lowest(glm::clamp(glm::floor(glm::min(a, glm::min(b, c))), vec2(0), last));
        const uvec2 highest(glm::clamp(glm::floor(glm::max(a, glm::max(b, c))), vec2(0), last));
        for (uint32_t y = lowest.y; y <= highest.y; ++y)
            for (uint32_t x = lowest.x; x <= highest.x; ++x)
                addAt({x, y}, triangle);
    }

    /// The points found at a place, by way of `points`.
    void appendPoints(uvec2 place, std::vector<SurfacePoint>& points) const
    {
        const size_t before = points.size(), index = indexOf(place);
        for (size_t k = 0; k < pattern_.size(); ++k)
            if (const SurfacePoint& point = found_[index * pattern_.size() + k]; point.triangle != kNoTriangle)
                points.push_back(point);
        if (points.size() == before && greatest_[index].area > 0)
            points.push_back(greatest_[index].middle);
    }

private:
    struct Part
    {
        float area = 0; // texels
        SurfacePoint middle;
    };

    [[nodiscard]] size_t indexOf(uvec2 place) const { return size_t{place.y} * extent_.x + place.x; }

    void addAt(uvec2 place, const PageTriangle& triangle)
    {
        const size_t index = indexOf(place);
        for (size_t k = 0; k < pattern_.size(); ++k)
            if (const vec2 barycentric = triangle.barycentric(vec2(place) + pattern_[k]); isInside(barycentric))
                found_[index * pattern_.size() + k] = onTriangle(triangle.index, barycentric);
        const Polygon part = partInTexel(triangle, place);
        if (const float area = areaOf(part); area > greatest_[index].area)
            greatest_[index] = {area, onTriangle(triangle.index, triangle.barycentric(middleOf(part)))};
    }

    uvec2 extent_;
    std::vector<vec2> pattern_;
    std::vector<SurfacePoint> found_;
    std::vector<Part> greatest_;
};

/// Steps from a place to those around it, the nearest first.
std::vector<ivec2> stepsWithin(uint32_t reach)
{
    const auto r = static_cast<int>(reach);
    std::vector<ivec2> steps;
    for (int y = -r; y <= r; ++y)
        for (int x = -r; x <= r; ++x)
            steps.push_back({x, y});
    const auto distance2 = [](ivec2 step) { return step.x * step.x + step.y * step.y; };
    std::ranges::stable_sort(steps, {}, distance2);
    return steps;
}

uint32_t texelAt(const TexelMap& map, ivec2 place)
{
    const ivec2 extent(map.extent);
    const bool isOnPage = place.x >= 0 && place.y >= 0 && place.x < extent.x && place.y < extent.y;
    return isOnPage ? map.texels[static_cast<size_t>(place.y) * map.extent.x + static_cast<size_t>(place.x)] : kNoTexel;
}

bool isValidTexel(uint32_t texel, std::span<const uint8_t> isValid) { return texel != kNoTexel && isValid[texel] != 0; }

} // namespace

TexelMap mapTexels(const StaticScene& scene, uint32_t mostPoints)
{
    check(mostPoints > 0, "a point a texel at least");
    const uvec2 extent = scene.atlasExtent;
    Coverage coverage(extent, mostPoints);
    for (uint32_t triangle = 0; triangle < scene.triangleCount(); ++triangle) {
        std::array<vec2, 3> corners;
        for (size_t k = 0; k < 3; ++k)
            corners[k] = scene.bakeUvs[scene.indices[size_t{3} * triangle + k]] * vec2(extent);
        const float doubleArea = crossed(corners[1] - corners[0], corners[2] - corners[0]);
        if (doubleArea != 0)
            coverage.add({triangle, corners, doubleArea});
    }

    TexelMap map;
    map.extent = extent;
    map.texels.assign(size_t{extent.x} * extent.y, kNoTexel);
    for (uint32_t y = 0; y < extent.y; ++y)
        for (uint32_t x = 0; x < extent.x; ++x) {
            const auto first = static_cast<uint32_t>(map.points.size());
            coverage.appendPoints({x, y}, map.points);
            if (map.points.size() == first)
                continue;
            map.texels[size_t{y} * extent.x + x] = map.texelCount();
            map.places.push_back({x, y});
            map.firstPoints.push_back(first);
        }
    map.firstPoints.push_back(static_cast<uint32_t>(map.points.size()));
    return map;
}

Footprint footprintAt(const TexelMap& map, std::span<const uint8_t> isValid, vec2 bakeUv)
{
    const vec2 place = bakeUv * vec2(map.extent) - 0.5f;
    const vec2 corner = glm::floor(place), part = place - corner;
    Footprint footprint;
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 step(k & 1, k >> 1);
        const uint32_t texel = texelAt(map, ivec2(corner) + step);
        if (!isValidTexel(texel, isValid))
            continue;
        const float weight = (step.x == 1 ? part.x : 1 - part.x) * (step.y == 1 ? part.y : 1 - part.y);
        if (!(weight > 0))
            continue;
        footprint.texels[footprint.count] = texel;
        footprint.weights[footprint.count++] = weight;
        sum += weight;
    }
    for (uint32_t k = 0; k < footprint.count; ++k)
        footprint.weights[k] /= sum;
    return footprint;
}

std::vector<uint32_t> dilated(const TexelMap& map, std::span<const uint8_t> isValid, uint32_t reach)
{
    const std::vector<ivec2> steps = stepsWithin(reach);
    std::vector<uint32_t> sources(map.texels.size(), kNoTexel);
    for (uint32_t y = 0; y < map.extent.y; ++y)
        for (uint32_t x = 0; x < map.extent.x; ++x)
            for (const ivec2 step : steps)
                if (const uint32_t texel = texelAt(map, ivec2(x, y) + step); isValidTexel(texel, isValid)) {
                    sources[size_t{y} * map.extent.x + x] = texel;
                    break;
                }
    return sources;
}

} // namespace antumbra::bake
