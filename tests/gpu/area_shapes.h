// Bodies that tests put before area lights and into them: shapes about the origin, linked once, and placed by a function of their vertices.
#pragma once

#include "gpu/random_inputs.h"
#include "scene/convex_body.h"

namespace antumbra {

/// A flat polygon around +Z on the unit circle, whose front is +Z.
const scene::ConvexBody& polygonShape(uint32_t corners);
/// [-1, 1] in X and Y, whose front is +Z; its corners begin at (-1, -1).
const scene::ConvexBody& squareShape();
/// [-1, 1]^3.
const scene::ConvexBody& boxShape();
/// On the unit sphere, of triangles: 12, 42 or 162 vertices by 0, 1 or 2 subdivisions of an icosahedron.
const scene::ConvexBody& ballShape(uint32_t subdivisions);
/// On the unit sphere, of triangles: 154 vertices on 8 rings between two poles, with short edges around these.
const scene::ConvexBody& globeShape();
/// The polygon from Z = -1 to 1, with quads around it.
const scene::ConvexBody& prismShape(uint32_t corners);

/// The same body, of triangles that fan out from each face's first corner.
scene::ConvexBody triangulated(const scene::ConvexBody& body);
/// Triangles that fan out from each face's first corner; flat ones, for `vertices` placed likewise.
std::vector<scene::ConvexBody> trianglesOf(const scene::ConvexBody& body);
scene::ConvexBody triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
scene::ConvexBody quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// A turn and a scale along the axes before it.
struct Placement
{
    glm::dmat3 rotation{1};
    glm::dvec3 scale{1};
    glm::dvec3 position{0};

    glm::dvec3 operator()(const glm::dvec3& v) const { return rotation * (scale * v) + position; }
};

/// The shape with its vertices where `place` puts them, rounded once. It must not mirror.
template <class Place>
scene::ConvexBody placed(scene::ConvexBody shape, const Place& place)
{
    for (vec3& vertex : shape.vertices)
        vertex = vec3(place(glm::dvec3(vertex)));
    return shape;
}

/// Takes +Z to the axis, turned about it at random.
glm::dmat3 randomTurn(RandomInputs& random, const glm::dvec3& axis);

} // namespace antumbra
