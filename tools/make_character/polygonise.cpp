// Marching tetrahedra (Doi and Koide, IEICE Transactions 1991) over the six tetrahedra around each cell's diagonal: closed
// and manifold whatever the field, unlike marching cubes. Remeshing mends the poor triangles.
#include "tools/make_character/surface.h"

#include "base/check.h"

#include <algorithm>
#include <map>
#include <utility>

namespace antumbra::character {

namespace {

using Cell = glm::ivec3;

constexpr dvec3 kLowest{-0.7, -0.04, -0.2};
constexpr dvec3 kHighest{0.7, 1.82, 0.27};

/// A corner of the grid with the distance there.
struct Corner
{
    size_t index;
    dvec3 position;
    double distance;
};

using Tetrahedron = std::array<Corner, 4>;

class Polygoniser
{
public:
    explicit Polygoniser(double cell) : cell_(cell), size_(glm::ceil((kHighest - kLowest) / cell))
    {
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x)
                    distances_.push_back(distanceToBody(position({x, y, z})));
    }

    Surface polygonise()
    {
        for (int z = 0; z + 1 < size_.z; ++z)
            for (int y = 0; y + 1 < size_.y; ++y)
                for (int x = 0; x + 1 < size_.x; ++x)
                    cutCell({x, y, z});
        return std::move(surface_);
    }

private:
    [[nodiscard]] dvec3 position(Cell at) const { return kLowest + cell_ * dvec3(at); }
    [[nodiscard]] Corner corner(Cell at) const
    {
        const size_t index = (static_cast<size_t>(at.z) * size_.y + at.y) * size_.x + at.x;
        return {index, position(at), distances_[index]};
    }

    // Each order of the axes is a path along three edges from the lowest corner to the highest: a tetrahedron.
    void cutCell(Cell at)
    {
        std::array axes{0, 1, 2};
        do {
            Tetrahedron tetrahedron{corner(at)};
            Cell next = at;
            for (size_t i = 0; i < 3; ++i) {
                ++next[axes[i]];
                tetrahedron[i + 1] = corner(next);
            }
            cut(tetrahedron);
        } while (std::ranges::next_permutation(axes).found);
    }

    void cut(Tetrahedron corners)
    {
        const auto firstOutside = std::stable_partition(corners.begin(), corners.end(), [](const Corner& c) { return c.distance < 0; });
        const std::ptrdiff_t insideCount = firstOutside - corners.begin();
        const auto& [a, b, c, d] = corners;
        const dvec3 outwards = d.position - a.position;
        if (insideCount == 1)
            addTriangle({crossing(a, b), crossing(a, c), crossing(a, d)}, outwards);
        if (insideCount == 3)
            addTriangle({crossing(a, d), crossing(b, d), crossing(c, d)}, outwards);
        if (insideCount == 2) {
            addTriangle({crossing(a, c), crossing(a, d), crossing(b, d)}, outwards);
            addTriangle({crossing(a, c), crossing(b, d), crossing(b, c)}, outwards);
        }
    }

    uint32_t crossing(const Corner& inside, const Corner& outside)
    {
        constexpr double kMargin = 0.1; // of the edge, so that no triangle is degenerate
        const auto [entry, isNew] =
            vertices_.try_emplace(std::minmax(inside.index, outside.index), static_cast<uint32_t>(surface_.positions.size()));
        if (isNew) {
            const double share = inside.distance / (inside.distance - outside.distance);
            surface_.positions.push_back(snapped(glm::mix(inside.position, outside.position, std::clamp(share, kMargin, 1 - kMargin))));
        }
        return entry->second;
    }

    void addTriangle(glm::uvec3 triangle, const dvec3& outwards)
    {
        const dvec3 a = surface_.positions[triangle.x], b = surface_.positions[triangle.y], c = surface_.positions[triangle.z];
        if (glm::dot(glm::cross(b - a, c - a), outwards) < 0)
            std::swap(triangle.y, triangle.z);
        surface_.triangles.push_back(triangle);
    }

    double cell_;
    Cell size_;
    std::vector<double> distances_;
    std::map<std::pair<size_t, size_t>, uint32_t> vertices_;
    Surface surface_;
};

} // namespace

Surface polygonise(double cell)
{
    Surface surface = Polygoniser(cell).polygonise();
    check(isClosed(surface), "a body inside the grid");
    return surface;
}

bool isClosed(const Surface& surface)
{
    std::map<std::pair<uint32_t, uint32_t>, int> passes;
    for (const glm::uvec3& t : surface.triangles)
        for (int i = 0; i < 3; ++i)
            ++passes[{t[i], t[(i + 1) % 3]}];
    for (const auto& [edge, count] : passes) {
        const auto back = passes.find({edge.second, edge.first});
        if (count != 1 || back == passes.end() || back->second != 1)
            return false;
    }
    return true;
}

} // namespace antumbra::character
