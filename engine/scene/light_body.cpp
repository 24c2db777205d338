#include "scene/light_body.h"

#include "base/check.h"
#include "scene/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace antumbra::scene {

namespace {

constexpr double kPiDouble = std::numbers::pi;

bool isLength(float value) { return value > 0 && value <= std::numeric_limits<float>::max(); }

Loop countedLoop(uint32_t count)
{
    Loop loop(count);
    std::iota(loop.begin(), loop.end(), 0u);
    return loop;
}

ConvexBody planarBody(std::vector<vec3> vertices)
{
    const std::vector<Loop> loops{countedLoop(static_cast<uint32_t>(vertices.size()))};
    return makeBody(std::move(vertices), loops);
}

ConvexBody quadBody(vec2 size)
{
    const vec2 half = 0.5f * size;
    return planarBody({{-half.x, 0, half.y}, {half.x, 0, half.y}, {half.x, 0, -half.y}, {-half.x, 0, -half.y}});
}

/// Corners of a regular polygon, counter-clockwise seen from +Y.
std::vector<vec3> ring(uint32_t segments, glm::dvec2 radii, double y)
{
    std::vector<vec3> corners;
    for (uint32_t i = 0; i < segments; ++i) {
        const double angle = 2 * kPiDouble * i / segments;
        corners.emplace_back(radii.x * std::cos(angle), y, -radii.y * std::sin(angle));
    }
    return corners;
}

/// Of a regular polygon whose corners have the distance 1 from its middle.
double polygonArea(uint32_t segments) { return 0.5 * segments * std::sin(2 * kPiDouble / segments); }
double polygonOutline(uint32_t segments) { return 2 * segments * std::sin(kPiDouble / segments); }

ConvexBody diskBody(vec2 radii, uint32_t segments)
{
    return planarBody(ring(segments, glm::dvec2(radii) * std::sqrt(kPiDouble / polygonArea(segments)), 0));
}

ConvexBody cylinderBody(double radius, double length, uint32_t segments)
{
    // 2 base R^2 + outline length R = the cylinder's surface, solved for R.
    const double base = polygonArea(segments);
    const double halfSide = 0.5 * polygonOutline(segments) * length;
    const double surface = 2 * kPiDouble * radius * (radius + length);
    const double prismRadius = surface / (halfSide + std::sqrt(halfSide * halfSide + 2 * base * surface));

    std::vector<vec3> vertices = ring(segments, glm::dvec2(prismRadius), 0.5 * length);
    const std::vector<vec3> bottom = ring(segments, glm::dvec2(prismRadius), -0.5 * length);
    vertices.insert(vertices.end(), bottom.begin(), bottom.end());
    std::vector<Loop> loops{countedLoop(segments), {}};
    for (uint32_t i = 0; i < segments; ++i) {
        const uint32_t next = (i + 1) % segments;
        loops[1].push_back(2 * segments - 1 - i);
        loops.push_back({i, segments + i, segments + next, next});
    }
    return makeBody(std::move(vertices), loops);
}

std::optional<ConvexBody> polygonBody(std::span<const vec2> corners)
{
    std::vector<glm::dvec2> points; // x and -z: counter-clockwise there is counter-clockwise seen from +Y
    for (const vec2& corner : corners) {
        check(std::isfinite(corner.x) && std::isfinite(corner.y), "corners of a light are finite");
        points.emplace_back(corner.x, -corner.y);
    }
    const Loop outline = outlineOf(points);
    if (outline.size() < 3)
        return std::nullopt;
    std::vector<vec3> vertices;
    for (const uint32_t corner : outline)
        vertices.emplace_back(corners[corner].x, 0, corners[corner].y);
    return planarBody(std::move(vertices));
}

vec3 onUnitSphere(glm::dvec3 point) { return vec3(glm::normalize(point)); }

ConvexBody icosahedron()
{
    const float g = std::numbers::phi_v<float>;
    std::vector<vec3> vertices{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                               {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (vec3& vertex : vertices)
        vertex = onUnitSphere(vertex);
    const std::vector<Loop> loops{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return makeBody(std::move(vertices), loops);
}

/// Every triangle of a body on the unit sphere split into frequency^2.
ConvexBody subdivided(const ConvexBody& body, uint32_t frequency)
{
    std::vector<vec3> vertices;
    std::vector<Loop> loops;
    // Places on an edge belong to two triangles: known by the corners of the body and their shares.
    std::map<std::array<std::pair<uint32_t, uint32_t>, 3>, uint32_t> places;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const std::span<const uint32_t> corners = body.loop(face);
        const auto place = [&](uint32_t i, uint32_t j) {
            const std::array<uint32_t, 3> shares{frequency - i - j, i, j};
            std::array<std::pair<uint32_t, uint32_t>, 3> key{};
            glm::dvec3 point(0);
            for (size_t k = 0; k < 3; ++k) {
                key[k] = shares[k] == 0 ? std::pair{kNoIndex, 0u} : std::pair{corners[k], shares[k]};
                point += static_cast<double>(shares[k]) * glm::dvec3(body.vertices[corners[k]]);
            }
            std::ranges::sort(key);
            const auto [found, isNew] = places.insert({key, static_cast<uint32_t>(vertices.size())});
            if (isNew)
                vertices.push_back(onUnitSphere(point));
            return found->second;
        };
        for (uint32_t i = 0; i < frequency; ++i)
            for (uint32_t j = 0; i + j < frequency; ++j) {
                loops.push_back({place(i, j), place(i + 1, j), place(i, j + 1)});
                if (i + j + 1 < frequency)
                    loops.push_back({place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)});
            }
    }
    return makeBody(std::move(vertices), loops);
}

/// A vertex more in the middle of every triangle, and every edge turned to join two of them.
ConvexBody withMiddles(const ConvexBody& body)
{
    std::vector<vec3> vertices = body.vertices;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        glm::dvec3 sum(0);
        for (const uint32_t corner : body.loop(face))
            sum += glm::dvec3(body.vertices[corner]);
        vertices.push_back(onUnitSphere(sum));
    }
    const auto middle = [&](uint32_t face) { return static_cast<uint32_t>(body.vertices.size()) + face; };
    std::vector<Loop> loops;
    for (const ConvexBody::Edge& edge : body.edges) {
        loops.push_back({edge.a, middle(edge.right), middle(edge.left)});
        loops.push_back({edge.b, middle(edge.left), middle(edge.right)});
    }
    return makeBody(std::move(vertices), loops);
}

ConvexBody sphereBody(double radius, uint32_t wantedVertices)
{
    // An icosahedron in triangles of frequency^2, or three times that with middles: 10 t + 2 vertices.
    const double wanted = std::max(1.0, (wantedVertices - 2.0) / 10);
    const auto plain = static_cast<uint32_t>(std::lround(std::sqrt(wanted)));
    const auto tripled = std::max(1u, static_cast<uint32_t>(std::lround(std::sqrt(wanted / 3))));
    const bool isPlain = std::abs(plain * plain - wanted) <= std::abs(3.0 * tripled * tripled - wanted);
    ConvexBody body = isPlain ? subdivided(icosahedron(), plain) : withMiddles(subdivided(icosahedron(), tripled));
    const double scale = radius * std::sqrt(4 * kPiDouble / surfaceArea(body));
    for (vec3& vertex : body.vertices)
        vertex = vec3(scale * glm::dvec3(vertex));
    return body;
}

} // namespace

std::optional<ConvexBody> lightBody(const AreaLight& light, const Mesh* ownMesh, uint32_t segments)
{
    check(segments >= 3 && segments <= 4096, "3 to 4096 segments");
    check(isLength(light.size.x) && isLength(light.size.y) && isLength(light.radii.x) && isLength(light.radii.y) && isLength(light.length),
          "lengths of a light are positive and finite");
    switch (light.shape) {
    case LightShape::Quad: return quadBody(light.size);
    case LightShape::Disk: return diskBody(light.radii, segments);
    case LightShape::Sphere: return sphereBody(light.radii.x, segments);
    case LightShape::Cylinder: return cylinderBody(light.radii.x, light.length, segments);
    case LightShape::Polygon: return polygonBody(std::span(light.outline).first(light.outlineCount));
    case LightShape::Mesh: check(ownMesh != nullptr, "a mesh light has a mesh"); return meshBody(*ownMesh);
    }
    return std::nullopt;
}

} // namespace antumbra::scene
