#include "scene/convex_body.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace antumbra::scene {

namespace {

/// The face that runs from the first vertex to the second.
using FacesByEdge = std::map<std::pair<uint32_t, uint32_t>, uint32_t>;

/// Calls visit(face, a, b) for every edge of every loop.
template <typename Visit>
void eachLoopEdge(const ConvexBody& body, Visit visit)
{
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const std::span<const uint32_t> loop = body.loop(face);
        for (size_t i = 0; i < loop.size(); ++i)
            visit(face, loop[i], loop[(i + 1) % loop.size()]);
    }
}

void addLoops(ConvexBody& body, std::span<const Loop> loops)
{
    for (const Loop& loop : loops) {
        check(loop.size() >= 3, "a face has three corners");
        check(std::ranges::all_of(loop, [&](uint32_t corner) { return corner < body.vertices.size(); }), "corners are vertices");
        body.faces.push_back({static_cast<uint32_t>(body.corners.size()), static_cast<uint32_t>(loop.size())});
        body.corners.insert(body.corners.end(), loop.begin(), loop.end());
    }
}

/// Along the face's normal, as long as twice its area.
glm::dvec3 newell(std::span<const uint32_t> loop, std::span<const vec3> vertices)
{
    const glm::dvec3 origin(vertices[loop[0]]);
    glm::dvec3 sum(0);
    for (size_t i = 1; i + 1 < loop.size(); ++i)
        sum += glm::cross(glm::dvec3(vertices[loop[i]]) - origin, glm::dvec3(vertices[loop[i + 1]]) - origin);
    return sum;
}

} // namespace

std::optional<ConvexBody> linkedBody(std::vector<vec3> vertices, std::span<const Loop> loops)
{
    const auto isFinite = [](vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    check(std::ranges::all_of(vertices, isFinite), "vertices of a body are finite");
    ConvexBody body;
    body.vertices = std::move(vertices);
    body.isPlanar = loops.size() == 1;
    addLoops(body, loops);

    FacesByEdge faces;
    bool isLinked = true;
    eachLoopEdge(body, [&](uint32_t face, uint32_t a, uint32_t b) { isLinked = faces.insert({{a, b}, face}).second && isLinked; });
    eachLoopEdge(body, [&](uint32_t face, uint32_t a, uint32_t b) {
        const auto opposite = faces.find({b, a});
        const uint32_t right = opposite == faces.end() ? ConvexBody::kNoFace : opposite->second;
        isLinked = isLinked && right != face;
        if (face < right)
            body.edges.push_back({a, b, face, right});
    });
    if (!isLinked)
        return std::nullopt;
    return body;
}

ConvexBody makeBody(std::vector<vec3> vertices, std::span<const Loop> loops)
{
    std::optional<ConvexBody> body = linkedBody(std::move(vertices), loops);
    check(body.has_value(), "an edge is run through once in each direction");
    return *std::move(body);
}

bool isClosed(const ConvexBody& body)
{
    return std::ranges::none_of(body.edges, [](const ConvexBody::Edge& edge) { return edge.right == ConvexBody::kNoFace; });
}

std::vector<glm::dvec3> faceNormals(const ConvexBody& body, std::span<const vec3> vertices)
{
    check(vertices.size() == body.vertices.size(), "a place for every vertex");
    std::vector<glm::dvec3> normals;
    normals.reserve(body.faces.size());
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const glm::dvec3 twiceArea = newell(body.loop(face), vertices);
        const double length = glm::length(twiceArea);
        normals.push_back(length > 0 ? twiceArea / length : glm::dvec3(0));
    }
    return normals;
}

std::vector<glm::dvec3> faceNormals(const ConvexBody& body) { return faceNormals(body, body.vertices); }

double surfaceArea(const ConvexBody& body)
{
    double area = 0;
    for (uint32_t face = 0; face < body.faces.size(); ++face)
        area += 0.5 * glm::length(newell(body.loop(face), body.vertices));
    return area;
}

ConvexBody transformed(const ConvexBody& body, const mat4& matrix)
{
    ConvexBody result = body;
    for (vec3& vertex : result.vertices)
        vertex = vec3(matrix * vec4(vertex, 1));
    if (glm::determinant(glm::dmat3(matrix)) >= 0)
        return result;
    for (const ConvexBody::Face& face : result.faces) {
        const auto loop = std::span(result.corners).subspan(face.firstCorner, face.cornerCount);
        std::reverse(loop.begin(), loop.end());
    }
    for (ConvexBody::Edge& edge : result.edges)
        std::swap(edge.a, edge.b);
    return result;
}

Mesh meshOf(const ConvexBody& body)
{
    Mesh mesh;
    const std::vector<glm::dvec3> normals = faceNormals(body);
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        if (normals[face] == glm::dvec3(0))
            continue;
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        const std::span<const uint32_t> loop = body.loop(face);
        for (const uint32_t corner : loop)
            mesh.positions.push_back(body.vertices[corner]);
        mesh.normals.insert(mesh.normals.end(), loop.size(), vec3(normals[face]));
        for (uint32_t i = 1; i + 1 < loop.size(); ++i) {
            mesh.indices.insert(mesh.indices.end(), {first, first + i, first + i + 1});
            mesh.triangleMaterials.push_back(0);
        }
    }
    mesh.uvs.resize(mesh.positions.size(), vec2{0});
    return mesh;
}

} // namespace antumbra::scene
