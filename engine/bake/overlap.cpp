// Separating axes (of two triangles that do not overlap, one has an edge with the other wholly beyond it), over the pairs of a grid.
#include "bake/overlap.h"

#include <algorithm>
#include <cmath>

namespace antumbra::bake {

namespace {

constexpr uint32_t kNone = ~0u;
constexpr float kToleranceShare = 1.0f / 16384.0f;

/// Whether `other` lies beyond one of the edges of `triangle`, but for `tolerance`.
bool isSeparatedByEdge(const FlatTriangle& triangle, const FlatTriangle& other, float tolerance)
{
    const float winding = twiceArea(triangle) < 0 ? -1.0f : 1.0f;
    for (size_t i = 0; i < 3; ++i) {
        const vec2 start = triangle[i];
        const vec2 edge = triangle[(i + 1) % 3] - start;
        const vec2 inwards = winding * vec2(-edge.y, edge.x);
        float deepest = glm::dot(inwards, other[0] - start);
        for (size_t k = 1; k < 3; ++k)
            deepest = std::max(deepest, glm::dot(inwards, other[k] - start));
        if (deepest <= tolerance * glm::length(edge))
            return true;
    }
    return false;
}

} // namespace

FlatTriangles::FlatTriangles(vec2 lowest, vec2 highest, size_t count) : lowest_(lowest)
{
    const vec2 extent = highest - lowest;
    const float longest = std::max(extent.x, extent.y);
    tolerance_ = kToleranceShare * longest;
    if (longest > 0) {
        // About a cell a triangle, as square as the box allows.
        const vec2 sides = glm::max(extent, vec2(longest / static_cast<float>(count + 1)));
        const float cell = std::sqrt(sides.x * sides.y / static_cast<float>(count + 1));
        cellCount_ = uvec2(glm::max(glm::ceil(sides / cell), vec2(1)));
        cellsPerUnit_ = vec2(cellCount_) / sides;
    }
    heads_.assign(size_t{cellCount_.x} * cellCount_.y, kNone);
    triangles_.reserve(count);
}

bool FlatTriangles::add(const FlatTriangle& triangle)
{
    const Cells cells = cellsUnder(triangle);
    if (!isFree(triangle, cells))
        return false;
    const auto index = static_cast<uint32_t>(triangles_.size());
    triangles_.push_back(triangle);
    for (uint32_t y = cells.first.y; y <= cells.last.y; ++y)
        for (uint32_t x = cells.first.x; x <= cells.last.x; ++x) {
            uint32_t& head = heads_[size_t{y} * cellCount_.x + x];
            entries_.push_back({index, head});
            head = static_cast<uint32_t>(entries_.size() - 1);
        }
    return true;
}

FlatTriangles::Cells FlatTriangles::cellsUnder(const FlatTriangle& triangle) const
{
    const auto cellAt = [&](vec2 place) { return uvec2(glm::clamp((place - lowest_) * cellsPerUnit_, vec2(0), vec2(cellCount_ - 1u))); };
    return {cellAt(glm::min(glm::min(triangle[0], triangle[1]), triangle[2])),
            cellAt(glm::max(glm::max(triangle[0], triangle[1]), triangle[2]))};
}

bool FlatTriangles::isFree(const FlatTriangle& triangle, const Cells& cells) const
{
    for (uint32_t y = cells.first.y; y <= cells.last.y; ++y)
        for (uint32_t x = cells.first.x; x <= cells.last.x; ++x)
            for (uint32_t i = heads_[size_t{y} * cellCount_.x + x]; i != kNone; i = entries_[i].next) {
                const FlatTriangle& there = triangles_[entries_[i].triangle];
                if (!isSeparatedByEdge(triangle, there, tolerance_) && !isSeparatedByEdge(there, triangle, tolerance_))
                    return false;
            }
    return true;
}

} // namespace antumbra::bake
