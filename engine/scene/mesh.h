// Triangles as the renderer takes them: every vertex stream in its own array, all of one length or empty.
#pragma once

#include "base/bounds.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace antumbra::scene {

inline constexpr uint32_t kNoIndex = ~0u;

/// The joints that move a vertex and their shares; shares sum to one.
struct Influence
{
    std::array<uint16_t, 4> joints{};
    std::array<float, 4> weights{1, 0, 0, 0};
};

/// Offsets of the vertices [firstVertex, firstVertex + positions.size()) at weight one. `normals` is empty or as long.
struct MorphTarget
{
    uint32_t firstVertex = 0;
    std::vector<vec3> positions;
    std::vector<vec3> normals;
};

struct Mesh
{
    std::vector<vec3> positions;             // metres, bind space
    std::vector<vec3> normals;               // unit
    std::vector<vec2> uvs;                   // of the base colour texture; zero where there are none
    std::vector<vec2> bakeUvs;               // TEXCOORD_1, or empty
    std::vector<Influence> influences;       // into Model::joints
    std::vector<uint32_t> indices;           // three a triangle, counter-clockwise seen from outside
    std::vector<uint32_t> triangleMaterials; // one a triangle, into Model::materials
    std::vector<MorphTarget> morphTargets;

    [[nodiscard]] Aabb bounds() const
    {
        Aabb box;
        for (const vec3& position : positions)
            box.add(position);
        return box;
    }
};

/// Reorders the triangles so that halving the index buffer again and again separates them well in space (axis by surface-area
/// cost). Builders that split where the buffer does get a good tree; others do not mind. `restPositions`, one a vertex, are
/// where the vertices stand in the pose that counts: the rest pose of a model, mesh.positions of a rigid mesh.
void orderTriangles(Mesh& mesh, std::span<const vec3> restPositions);

Mesh makePlane();  // 1 x 1 m in XZ, normal +Y
Mesh makeCube();   // edges of 1 m
Mesh makeSphere(); // diameter 1 m

} // namespace antumbra::scene
