#include "render/body_blocks.h"

#include "base/bounds.h"
#include "base/check.h"

#include <algorithm>
#include <cmath>

namespace antumbra::render {

namespace {

/// A sphere around points: about the middle of their box.
void bound(shader::BodyBlock& block, std::span<const vec3> points)
{
    Aabb box;
    for (const vec3& point : points)
        box.add(point);
    block.centre = box.centre();
    float radius = 0;
    for (const vec3& point : points)
        radius = std::max(radius, glm::distance(point, block.centre));
    block.radius = radius * 1.000001f; // past its rounding
}

shader::EdgeBlock packed(const scene::ConvexBody::Edge& edge, bool isMirrored)
{
    const uint32_t a = isMirrored ? edge.b : edge.a, b = isMirrored ? edge.a : edge.b;
    const uint32_t right = edge.right == scene::ConvexBody::kNoFace ? shader::kNoFace : edge.right;
    return {a | b << 16u, edge.left | right << 16u};
}

} // namespace

uint32_t BodyBlocks::add(const scene::ConvexBody& body, const mat4& toWorld, uint32_t flags, float margin)
{
    check(body.vertices.size() < shader::kNoFace && body.faces.size() < shader::kNoFace, "a body whose indices fit 16 bits");
    const float volumeScale = glm::determinant(mat3(toWorld));
    const bool isMirrored = volumeScale < 0;
    shader::BodyBlock block{.firstVertex = static_cast<uint32_t>(vertices.size()),
                            .vertexCount = static_cast<uint32_t>(body.vertices.size()),
                            .firstFace = static_cast<uint32_t>(faces.size()),
                            .faceCount = static_cast<uint32_t>(body.faces.size()),
                            .firstEdge = static_cast<uint32_t>(edges.size()),
                            .edgeCount = static_cast<uint32_t>(body.edges.size()),
                            .flags = flags | (body.isPlanar ? shader::kBodyPlanar : 0u),
                            .margin = margin * std::cbrt(std::abs(volumeScale))};
    for (const vec3& vertex : body.vertices)
        vertices.emplace_back(toWorld * vec4(vertex, 1));
    const auto moved = std::span(vertices).subspan(block.firstVertex);
    bound(block, moved);
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const auto loop = body.loop(face);
        const vec3 normal(scene::faceNormal(body, face, moved) * (isMirrored ? -1.0 : 1.0));
        faces.push_back({normal, static_cast<uint32_t>(corners.size()), static_cast<uint32_t>(loop.size())});
        corners.insert(corners.end(), loop.begin(), loop.end());
        if (isMirrored)
            std::reverse(corners.end() - static_cast<std::ptrdiff_t>(loop.size()), corners.end());
    }
    for (const scene::ConvexBody::Edge& edge : body.edges)
        edges.push_back(packed(edge, isMirrored));
    bodies.push_back(block);
    return static_cast<uint32_t>(bodies.size() - 1);
}

void BodyBlocks::clear()
{
    bodies.clear();
    vertices.clear();
    faces.clear();
    corners.clear();
    edges.clear();
}

} // namespace antumbra::render
