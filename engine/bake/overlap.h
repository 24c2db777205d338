// Triangles in a plane, and whether another one would lie on top of them. Knows nothing of meshes.
#pragma once

#include "base/math.h"

#include <array>
#include <cstdint>
#include <vector>

namespace antumbra::bake {

using FlatTriangle = std::array<vec2, 3>;

/// Twice the signed area: positive where the corners run counter-clockwise.
inline float twiceArea(const FlatTriangle& t)
{
    const vec2 u = t[1] - t[0], v = t[2] - t[0];
    return u.x * v.y - u.y * v.x;
}

/// Triangles that overlap nowhere, in a grid of cells.
class FlatTriangles
{
public:
    /// All triangles to come lie within lowest..highest; there will be about `count`. What overlaps by less than a 16384th of that box's
    /// longer side does not count.
    FlatTriangles(vec2 lowest, vec2 highest, size_t count);

    /// False where it would overlap one that is there already, and then it is left out. Touching is allowed.
    bool add(const FlatTriangle& triangle);

private:
    struct Entry
    {
        uint32_t triangle;
        uint32_t next; // in the same cell
    };
    struct Cells
    {
        uvec2 first;
        uvec2 last;
    };

    [[nodiscard]] Cells cellsUnder(const FlatTriangle& triangle) const;
    [[nodiscard]] bool isFree(const FlatTriangle& triangle, const Cells& cells) const;

    vec2 lowest_;
    vec2 cellsPerUnit_{0};
    uvec2 cellCount_{1};
    float tolerance_;
    std::vector<FlatTriangle> triangles_;
    std::vector<uint32_t> heads_; // one a cell, into entries_
    std::vector<Entry> entries_;
};

} // namespace antumbra::bake
