#include "scene/mesh.h"

#include "base/check.h"
#include "base/math.h"

#include <algorithm>
#include <limits>

namespace antumbra::scene {

namespace {

struct BoxedTriangle
{
    Aabb box;
    vec3 centre;
    uint32_t index;
};

std::vector<BoxedTriangle> boxTriangles(const Mesh& mesh, std::span<const vec3> positions)
{
    std::vector<BoxedTriangle> triangles(mesh.indices.size() / 3);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        BoxedTriangle& triangle = triangles[i];
        triangle.index = i;
        for (uint32_t corner = 0; corner < 3; ++corner)
            triangle.box.add(positions[mesh.indices[3 * i + corner]]);
        triangle.centre = triangle.box.centre();
    }
    return triangles;
}

float totalArea(std::span<const BoxedTriangle> triangles)
{
    Aabb box;
    for (const BoxedTriangle& triangle : triangles)
        box.add(triangle.box);
    return box.surfaceArea() * static_cast<float>(triangles.size());
}

void splitAlong(std::span<BoxedTriangle> triangles, size_t half, int axis)
{
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end(),
                     [axis](const BoxedTriangle& a, const BoxedTriangle& b) {
                         return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.index < b.index;
                     });
}

// The builder puts the triangles first..(first + last) / 2, both included, to the left: the larger half when their number is odd.
void orderHalves(std::span<BoxedTriangle> triangles)
{
    if (triangles.size() <= 2)
        return;
    const size_t half = (triangles.size() + 1) / 2;
    int bestAxis = 0;
    float bestCost = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        splitAlong(triangles, half, axis);
        const float cost = totalArea(triangles.first(half)) + totalArea(triangles.subspan(half));
        if (cost < bestCost) {
            bestCost = cost;
            bestAxis = axis;
        }
    }
    splitAlong(triangles, half, bestAxis);
    orderHalves(triangles.first(half));
    orderHalves(triangles.subspan(half));
}

// A flat rectangle centre +- halfU +- halfV that faces cross(halfU, halfV).
void addRectangle(Mesh& mesh, vec3 centre, vec3 halfU, vec3 halfV)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const vec2 corner : {vec2{-1, -1}, vec2{1, -1}, vec2{1, 1}, vec2{-1, 1}}) {
        mesh.positions.push_back(centre + corner.x * halfU + corner.y * halfV);
        mesh.normals.push_back(glm::normalize(glm::cross(halfU, halfV)));
        mesh.uvs.push_back(0.5f + vec2{0.5f, -0.5f} * corner);
    }
    for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + corner);
    mesh.triangleMaterials.insert(mesh.triangleMaterials.end(), 2, 0);
}

} // namespace

void orderTriangles(Mesh& mesh, std::span<const vec3> restPositions)
{
    check(mesh.indices.size() == 3 * mesh.triangleMaterials.size(), "three indices and one material a triangle");
    check(restPositions.size() == mesh.positions.size(), "a rest position for every vertex");
    std::vector<BoxedTriangle> triangles = boxTriangles(mesh, restPositions);
    orderHalves(triangles);

    const std::vector<uint32_t> indices = mesh.indices;
    const std::vector<uint32_t> materials = mesh.triangleMaterials;
    for (size_t i = 0; i < triangles.size(); ++i) {
        std::copy_n(&indices[3 * size_t{triangles[i].index}], 3, &mesh.indices[3 * i]);
        mesh.triangleMaterials[i] = materials[triangles[i].index];
    }
}

Mesh makePlane()
{
    Mesh mesh;
    addRectangle(mesh, vec3{0}, {0.5f, 0, 0}, {0, 0, -0.5f});
    return mesh;
}

Mesh makeCube()
{
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 normal{0};
        vec3 u{0};
        vec3 v{0};
        normal[axis] = u[(axis + 1) % 3] = v[(axis + 2) % 3] = 0.5f;
        addRectangle(mesh, normal, u, v);
        addRectangle(mesh, -normal, -u, v);
    }
    return mesh;
}

Mesh makeSphere()
{
    constexpr uint32_t kRings = 24;
    constexpr uint32_t kSegments = 48;
    Mesh mesh;
    for (uint32_t ring = 0; ring <= kRings; ++ring)
        for (uint32_t segment = 0; segment <= kSegments; ++segment) {
            const vec2 uv = vec2(segment, ring) / vec2(kSegments, kRings);
            const float polar = kPi * uv.y;
            const float azimuth = 2 * kPi * uv.x;
            const vec3 normal{std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth)};
            mesh.positions.push_back(0.5f * normal);
            mesh.normals.push_back(normal);
            mesh.uvs.push_back(uv);
        }
    const auto addTriangle = [&mesh](uint32_t a, uint32_t b, uint32_t c) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
        mesh.triangleMaterials.push_back(0);
    };
    for (uint32_t ring = 0; ring < kRings; ++ring)
        for (uint32_t segment = 0; segment < kSegments; ++segment) {
            const uint32_t above = ring * (kSegments + 1) + segment;
            const uint32_t below = above + kSegments + 1;
            // At the poles one of the two triangles has no area.
            if (ring + 1 != kRings)
                addTriangle(above, below, below + 1);
            if (ring != 0)
                addTriangle(above, below + 1, above + 1);
        }
    return mesh;
}

} // namespace antumbra::scene
