#include "render/clusters.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace antumbra::render {

namespace {

/// The triangles by material.
std::vector<uint32_t> sortedTriangles(const scene::Mesh& mesh)
{
    std::vector<uint32_t> triangles(mesh.triangleMaterials.size());
    std::iota(triangles.begin(), triangles.end(), 0u);
    std::ranges::stable_sort(triangles, {}, [&](uint32_t triangle) { return mesh.triangleMaterials[triangle]; });
    return triangles;
}

void cutHalves(std::vector<Cluster>& clusters, const Cluster& whole, uint32_t mostTriangles)
{
    const uint32_t triangleCount = whole.indexCount / 3;
    if (triangleCount <= mostTriangles) {
        clusters.push_back(whole);
        return;
    }
    Cluster left = whole, right = whole;
    left.indexCount = 3 * ((triangleCount + 1) / 2);
    right.firstIndex += left.indexCount;
    right.indexCount -= left.indexCount;
    cutHalves(clusters, left, mostTriangles);
    cutHalves(clusters, right, mostTriangles);
}

} // namespace

ClusteredTriangles clustersOf(const scene::Mesh& mesh, std::span<const vec3> restPositions, uint32_t mostTriangles)
{
    check(mostTriangles > 0, "clusters of at least one triangle");
    const std::vector<uint32_t> triangles = sortedTriangles(mesh);
    ClusteredTriangles made;
    scene::Mesh part;
    part.positions.assign(restPositions.begin(), restPositions.end());
    for (size_t first = 0; first < triangles.size(); first += part.triangleMaterials.size()) {
        const uint32_t material = mesh.triangleMaterials[triangles[first]];
        part.indices.clear();
        part.triangleMaterials.clear();
        for (size_t i = first; i < triangles.size() && mesh.triangleMaterials[triangles[i]] == material; ++i) {
            const auto corners = std::span(mesh.indices).subspan(3 * size_t{triangles[i]}, 3);
            part.indices.insert(part.indices.end(), corners.begin(), corners.end());
            part.triangleMaterials.push_back(material);
        }
        scene::orderTriangles(part, restPositions);
        cutHalves(made.clusters,
                  {.material = material,
                   .firstIndex = static_cast<uint32_t>(made.indices.size()),
                   .indexCount = static_cast<uint32_t>(part.indices.size())},
                  mostTriangles);
        made.indices.insert(made.indices.end(), part.indices.begin(), part.indices.end());
    }
    for (Cluster& cluster : made.clusters)
        for (const uint32_t vertex : std::span(made.indices).subspan(cluster.firstIndex, cluster.indexCount))
            cluster.box.add(restPositions[vertex]);
    return made;
}

std::optional<float> farthestSeen(const Aabb& box, const mat4& clipFromLocal)
{
    const mat4 rows = glm::transpose(clipFromLocal);
    const vec4 centre{box.centre(), 1.0f};
    const vec3 half = 0.5f * box.extent();
    const auto greatest = [&](const vec4& plane) { return glm::dot(plane, centre) + glm::dot(glm::abs(vec3(plane)), half); };
    const std::array planes{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] - rows[2]};
    if (std::ranges::any_of(planes, [&](const vec4& plane) { return greatest(plane) < 0.0f; }))
        return std::nullopt;
    return greatest(rows[3]);
}

} // namespace antumbra::render
