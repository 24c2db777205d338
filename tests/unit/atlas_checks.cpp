#include "unit/atlas_checks.h"

#include "bake/charts.h"
#include "bake/overlap.h"
#include "base/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace antumbra::bake {

namespace {

using scene::Mesh;

constexpr uint32_t kGutter = 2;
constexpr float kNarrow = 4;    // texels
constexpr float kMostFine = 4;  // times the texels along a narrow side
constexpr float kRim = 1.0e-3f; // texels that rounding may take

FlatTriangle onPage(const Atlas& atlas, const Mesh& mesh, size_t triangle)
{
    FlatTriangle flat;
    for (size_t corner = 0; corner < 3; ++corner)
        flat[corner] = mesh.bakeUvs[mesh.indices[3 * triangle + corner]] * vec2(atlas.extent);
    return flat;
}

float areaInWorld(const Mesh& mesh, size_t triangle, const mat4& world)
{
    const mat3 linear(world);
    const vec3 a = mesh.positions[mesh.indices[3 * triangle]];
    const vec3 u = linear * (mesh.positions[mesh.indices[3 * triangle + 1]] - a);
    const vec3 v = linear * (mesh.positions[mesh.indices[3 * triangle + 2]] - a);
    return 0.5f * glm::length(glm::cross(u, v));
}

/// For every triangle the first one of its chart: those that share corners on the page.
std::vector<uint32_t> chartOfTriangles(const Mesh& mesh)
{
    std::map<std::pair<float, float>, uint32_t> corners;
    std::vector<uint32_t> parents(mesh.triangleMaterials.size());
    std::iota(parents.begin(), parents.end(), 0u);
    const auto rootOf = [&](uint32_t i) {
        while (parents[i] != i)
            i = parents[i] = parents[parents[i]];
        return i;
    };
    for (uint32_t i = 0; i < mesh.indices.size(); ++i) {
        const vec2 uv = mesh.bakeUvs[mesh.indices[i]];
        const uint32_t other = rootOf(corners.try_emplace({uv.x, uv.y}, i / 3).first->second), own = rootOf(i / 3);
        parents[std::max(other, own)] = std::min(other, own);
    }
    for (uint32_t& parent : parents)
        parent = rootOf(parent);
    return parents;
}

/// Whether a square of side 1 has more of the triangle than its rim.
bool touches(const FlatTriangle& triangle, vec2 square)
{
    const float winding = twiceArea(triangle) < 0 ? -1.0f : 1.0f;
    for (size_t i = 0; i < 3; ++i) {
        const vec2 edge = triangle[(i + 1) % 3] - triangle[i];
        const vec2 inwards = winding * vec2(-edge.y, edge.x);
        const vec2 deepest = square + vec2(inwards.x > 0, inwards.y > 0);
        if (glm::dot(inwards, deepest - triangle[i]) <= kRim * glm::length(edge))
            return false;
    }
    return true;
}

void expectGutters(const Atlas& atlas, const std::vector<uint32_t>& page)
{
    size_t tooNear = 0;
    const ivec2 extent(atlas.extent);
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) {
            const uint32_t chart = page[static_cast<size_t>(y * extent.x + x)];
            for (int dy = 0; chart != kNoChart && dy <= int{kGutter} && y + dy < extent.y; ++dy)
                for (int nx = std::max(x - int{kGutter}, 0); nx <= std::min(x + int{kGutter}, extent.x - 1); ++nx) {
                    const uint32_t other = page[static_cast<size_t>((y + dy) * extent.x + nx)];
                    tooNear += other != kNoChart && other != chart;
                }
        }
    EXPECT_EQ(tooNear, 0);
}

/// That no two triangles of a mesh overlap on the page.
void expectNoOverlap(const Atlas& atlas, const Mesh& mesh)
{
    FlatTriangles taken(vec2(0), vec2(atlas.extent), mesh.triangleMaterials.size());
    for (size_t i = 0; i < mesh.triangleMaterials.size(); ++i)
        ASSERT_TRUE(taken.add(onPage(atlas, mesh, i))) << "triangle " << i;
}

} // namespace

size_t chartCount(const Mesh& mesh)
{
    std::vector<uint32_t> charts = chartOfTriangles(mesh);
    std::ranges::sort(charts);
    return static_cast<size_t>(std::unique(charts.begin(), charts.end()) - charts.begin());
}

std::vector<uint32_t> paintCharts(const Atlas& atlas)
{
    std::vector<uint32_t> page(size_t{atlas.extent.x} * atlas.extent.y, kNoChart);
    uint32_t firstChart = 0;
    size_t shared = 0;
    for (const Mesh& mesh : atlas.meshes) {
        const std::vector<uint32_t> charts = chartOfTriangles(mesh);
        for (size_t i = 0; i < charts.size(); ++i) {
            const FlatTriangle triangle = onPage(atlas, mesh, i);
            const vec2 lowest = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]) + kRim;
            const vec2 highest = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]) - kRim;
            EXPECT_TRUE(lowest.x >= 1 && lowest.y >= 1 && highest.x <= atlas.extent.x - 1.0f && highest.y <= atlas.extent.y - 1.0f);
            for (auto y = static_cast<uint32_t>(lowest.y); y <= static_cast<uint32_t>(highest.y); ++y)
                for (auto x = static_cast<uint32_t>(lowest.x); x <= static_cast<uint32_t>(highest.x); ++x) {
                    if (!touches(triangle, vec2(x, y)))
                        continue;
                    uint32_t& there = page[size_t{y} * atlas.extent.x + x];
                    shared += there != kNoChart && there != firstChart + charts[i];
                    there = firstChart + charts[i];
                }
        }
        firstChart += static_cast<uint32_t>(charts.size());
    }
    EXPECT_EQ(shared, 0) << "texels with two charts";
    return page;
}

double expectSound(const Atlas& atlas, size_t objectCount, const AtlasSettings& settings)
{
    EXPECT_LE(atlas.texelsPerMetre, settings.texelsPerMetre);
    EXPECT_TRUE(atlas.extent.x <= settings.mostTexels && atlas.extent.y <= settings.mostTexels);
    EXPECT_TRUE(atlas.extent.x % 4 == 0 && atlas.extent.y % 4 == 0 && atlas.extent.x > 0 && atlas.extent.y > 0);
    EXPECT_EQ(atlas.meshes.size(), objectCount);
    for (size_t i = 0; i < atlas.meshes.size(); ++i) {
        const Mesh& mesh = atlas.meshes[i];
        EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
        EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
        EXPECT_EQ(mesh.bakeUvs.size(), mesh.positions.size());
        EXPECT_EQ(mesh.indices.size(), 3 * mesh.triangleMaterials.size());
        expectNoOverlap(atlas, mesh);
    }
    const std::vector<uint32_t> page = paintCharts(atlas);
    expectGutters(atlas, page);
    return 1 - static_cast<double>(std::ranges::count(page, kNoChart)) / static_cast<double>(page.size());
}

Densities densities(const Atlas& atlas, const Mesh& mesh, const mat4& world)
{
    const std::vector<uint32_t> charts = chartOfTriangles(mesh);
    std::vector<Rect> boxes(charts.size()); // of the page, texels; by the first triangle of a chart
    for (size_t i = 0; i < charts.size(); ++i)
        for (const vec2 corner : onPage(atlas, mesh, i))
            boxes[charts[i]].add(corner);

    Densities shares;
    const float asked = atlas.texelsPerMetre * atlas.texelsPerMetre;
    for (size_t i = 0; i < charts.size(); ++i) {
        const vec2 sides = boxes[charts[i]].extent();
        const float share = 0.5f * std::abs(twiceArea(onPage(atlas, mesh, i))) / (asked * areaInWorld(mesh, i, world));
        (std::min(sides.x, sides.y) > kNarrow + kRim ? shares.wide : shares.narrow).push_back(share);
    }
    std::ranges::sort(shares.wide);
    std::ranges::sort(shares.narrow);
    return shares;
}

void expectEvenDensity(const Atlas& atlas, const Mesh& mesh, const mat4& world)
{
    const auto [wide, narrow] = densities(atlas, mesh, world);
    const float least = 0.99f * std::cos(kRegionHalfAngle), most = 1.01f / std::cos(kRegionHalfAngle);
    if (!wide.empty()) {
        EXPECT_GE(wide.front(), least);
        EXPECT_LE(wide.back(), most);
        EXPECT_NEAR(wide[wide.size() / 2], 1, 0.1);
    }
    if (!narrow.empty()) {
        EXPECT_GE(narrow.front(), least);
        EXPECT_LE(narrow.back(), most * kMostFine * kMostFine);
    }
}

} // namespace antumbra::bake
