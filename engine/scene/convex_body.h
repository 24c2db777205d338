// The polyhedra that analytic area-light shadows are made from: lights and blockers as half-spaces and silhouettes.
// Stores and links faces; finds no hulls (bake/hulls.h) and proves no convexity (merged_body.h).
#pragma once

#include "scene/mesh.h"

#include <optional>

namespace antumbra::scene {

/// Vertices in order around a face.
using Loop = std::vector<uint32_t>;

/// A convex polyhedron, or a flat convex polygon, as half-spaces and silhouettes need it.
struct ConvexBody
{
    static constexpr uint32_t kNoFace = ~0u;

    struct Face
    {
        uint32_t firstCorner = 0;
        uint32_t cornerCount = 0;
    };
    /// Every edge once. It runs from a to b in the loop of face `left`, and from b to a in that of `right`.
    struct Edge
    {
        uint32_t a = 0;
        uint32_t b = 0;
        uint32_t left = 0;
        uint32_t right = kNoFace; // kNoFace where there is none: a planar body's, or an open one's
    };

    std::vector<vec3> vertices;    // metres
    std::vector<uint32_t> corners; // the faces' loops, counter-clockwise seen from outside
    std::vector<Face> faces;       // planar body: exactly one
    std::vector<Edge> edges;
    bool isPlanar = false; // seen counter-clockwise from the side it shines to

    [[nodiscard]] std::span<const uint32_t> loop(uint32_t face) const
    {
        return std::span(corners).subspan(faces[face].firstCorner, faces[face].cornerCount);
    }
};

/// Links the edges of loops of three corners and more; one loop makes a planar body. Vertices must be finite. Nothing where two
/// faces run through an edge in the same direction.
std::optional<ConvexBody> linkedBody(std::vector<vec3> vertices, std::span<const Loop> loops);

/// The same for loops that are known to be right: stops the program where linkedBody has nothing.
ConvexBody makeBody(std::vector<vec3> vertices, std::span<const Loop> loops);

/// Whether every edge has a face on both sides.
bool isClosed(const ConvexBody& body);

/// Unit, outwards, one a face; zero where a face has no area. By Newell's method in double. `vertices` stand for the body's own:
/// posed, or transformed without mirroring.
std::vector<glm::dvec3> faceNormals(const ConvexBody& body, std::span<const vec3> vertices);
std::vector<glm::dvec3> faceNormals(const ConvexBody& body);

/// m^2; of a planar body its one side. A fourth of it is what a closed convex body covers in the mean over all directions.
double surfaceArea(const ConvexBody& body);

/// Every vertex moved by an affine matrix; loops are turned where it mirrors, so that they stay counter-clockwise.
ConvexBody transformed(const ConvexBody& body, const mat4& matrix);

/// Triangles with flat normals, to draw the body with; faces without area are left out. A planar body shows the side it shines to.
Mesh meshOf(const ConvexBody& body);

} // namespace antumbra::scene
