#include "gpu/area_shapes.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace antumbra {

namespace {

using glm::dvec3;
using scene::ConvexBody;
using scene::Loop;

/// Made at the first call, and kept.
template <class Make>
const ConvexBody& kept(uint32_t key, Make make)
{
    static std::map<uint32_t, ConvexBody> bodies;
    const auto found = bodies.find(key);
    return found != bodies.end() ? found->second : bodies.emplace(key, make(key)).first->second;
}

std::vector<vec3> circle(uint32_t corners, double z)
{
    std::vector<vec3> vertices;
    for (uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        vertices.emplace_back(std::cos(angle), std::sin(angle), z);
    }
    return vertices;
}

Loop countTo(uint32_t count)
{
    Loop loop(count);
    std::iota(loop.begin(), loop.end(), 0u);
    return loop;
}

/// One face around all vertices.
ConvexBody flatBody(std::vector<vec3> vertices)
{
    const Loop loop = countTo(static_cast<uint32_t>(vertices.size()));
    return scene::makeBody(std::move(vertices), {&loop, 1});
}

ConvexBody icosahedron()
{
    const float t = 0.5f + std::sqrt(1.25f);
    const std::vector<Loop> faces{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    std::vector<vec3> vertices{{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                               {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    for (vec3& vertex : vertices)
        vertex = vec3(glm::normalize(dvec3(vertex)));
    return scene::makeBody(vertices, faces);
}

ConvexBody subdivided(const ConvexBody& body)
{
    std::vector<vec3> vertices = body.vertices;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [at, isNew] = middles.insert({{std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(vertices.size())});
        if (isNew)
            vertices.emplace_back(glm::normalize(dvec3(vertices[a]) + dvec3(vertices[b])));
        return at->second;
    };
    std::vector<Loop> faces;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const auto loop = body.loop(face);
        const uint32_t ab = middle(loop[0], loop[1]), bc = middle(loop[1], loop[2]), ca = middle(loop[2], loop[0]);
        faces.insert(faces.end(), {{loop[0], ab, ca}, {loop[1], bc, ab}, {loop[2], ca, bc}, {ab, bc, ca}});
    }
    return scene::makeBody(vertices, faces);
}

ConvexBody globe()
{
    constexpr uint32_t kRings = 8, kSpokes = 19, kSouth = 1 + kRings * kSpokes;
    std::vector<vec3> vertices{{0, 0, 1}};
    for (uint32_t ring = 1; ring <= kRings; ++ring)
        for (uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
            const double down = std::numbers::pi * ring / (kRings + 1), around = 2 * std::numbers::pi * spoke / kSpokes;
            vertices.emplace_back(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down));
        }
    vertices.emplace_back(0, 0, -1);
    std::vector<Loop> faces;
    for (uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
        const uint32_t next = (spoke + 1) % kSpokes;
        faces.push_back({0, 1 + spoke, 1 + next});
        for (uint32_t first = 1; first + kSpokes < kSouth; first += kSpokes) {
            const uint32_t a = first + spoke, b = first + next;
            faces.insert(faces.end(), {{a, a + kSpokes, b + kSpokes}, {a, b + kSpokes, b}});
        }
        faces.push_back({kSouth, kSouth - kSpokes + next, kSouth - kSpokes + spoke});
    }
    return scene::makeBody(vertices, faces);
}

ConvexBody prism(uint32_t corners)
{
    std::vector<vec3> vertices = circle(corners, 1);
    const std::vector<vec3> lower = circle(corners, -1);
    vertices.insert(vertices.end(), lower.begin(), lower.end());
    Loop top = countTo(corners), bottom;
    for (uint32_t i = 0; i < corners; ++i)
        bottom.push_back(2 * corners - 1 - i);
    std::vector<Loop> faces{top, bottom};
    for (uint32_t i = 0; i < corners; ++i) {
        const uint32_t next = (i + 1) % corners;
        faces.push_back({i, corners + i, corners + next, next});
    }
    return scene::makeBody(vertices, faces);
}

} // namespace

const ConvexBody& polygonShape(uint32_t corners)
{
    return kept(corners, [](uint32_t count) { return flatBody(circle(count, 0)); });
}

const ConvexBody& squareShape()
{
    static const ConvexBody kSquare = flatBody({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    return kSquare;
}

const ConvexBody& boxShape()
{
    static const ConvexBody kBox =
        scene::makeBody({{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}},
                        std::vector<Loop>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
    return kBox;
}

const ConvexBody& ballShape(uint32_t subdivisions)
{
    static const ConvexBody kBalls[] = {icosahedron(), subdivided(icosahedron()), subdivided(subdivided(icosahedron()))};
    return kBalls[subdivisions];
}

const ConvexBody& globeShape()
{
    static const ConvexBody kGlobe = globe();
    return kGlobe;
}

const ConvexBody& prismShape(uint32_t corners)
{
    return kept(corners, [](uint32_t count) { return prism(count); });
}

ConvexBody triangle(const dvec3& a, const dvec3& b, const dvec3& c)
{
    ConvexBody body = polygonShape(3);
    body.vertices = {vec3(a), vec3(b), vec3(c)};
    return body;
}

ConvexBody quad(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d)
{
    ConvexBody body = squareShape();
    body.vertices = {vec3(a), vec3(b), vec3(c), vec3(d)};
    return body;
}

ConvexBody triangulated(const ConvexBody& body)
{
    std::vector<Loop> triangles;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const auto loop = body.loop(face);
        for (size_t i = 1; i + 1 < loop.size(); ++i)
            triangles.push_back({loop[0], loop[i], loop[i + 1]});
    }
    return scene::makeBody(body.vertices, triangles);
}

std::vector<ConvexBody> trianglesOf(const ConvexBody& body)
{
    std::vector<ConvexBody> triangles;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const auto loop = body.loop(face);
        const auto corner = [&](size_t i) { return dvec3(body.vertices[loop[i]]); };
        for (size_t i = 1; i + 1 < loop.size(); ++i)
            triangles.push_back(triangle(corner(0), corner(i), corner(i + 1)));
    }
    return triangles;
}

glm::dmat3 randomTurn(RandomInputs& random, const dvec3& axis)
{
    const dvec3 z = glm::normalize(axis), x = random.perpendicularTo(z);
    return {x, glm::cross(z, x), z};
}

} // namespace antumbra
