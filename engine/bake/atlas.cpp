// Charts of all objects on one page. Triangles are sorted by where they are before anything is grown or placed, so that the order in
// which a file holds them changes nothing.
#include "bake/atlas.h"

#include "bake/charts.h"
#include "bake/packing.h"
#include "base/check.h"
#include "base/error.h"
#include "scene/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace antumbra::bake {

namespace {

constexpr uint32_t kMargin = 1;               // texels around a chart that are its own; two charts are twice as far apart
constexpr float kLeastShare = 1.0f / 16;      // of the density asked: what is worth having
constexpr float kHopelessShare = 1.0f / 4096; // below, charts do not shrink any more
constexpr float kDensityStep = 1.005f;
constexpr float kFewTexels = 4;
constexpr float kMostFine = 4;

/// One object: its triangles and their charts, whose triangles index the mesh's.
struct ChartedMesh
{
    scene::Mesh mesh;
    std::vector<Chart> charts;
};

bool hasArea(const std::array<vec3, 3>& corners)
{
    constexpr double kLeastSine = 1.0e-7;
    const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0], w = corners[2] - corners[1];
    const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
    return glm::length(glm::cross(u, v)) > kLeastSine * longest; // false for what is not finite
}

/// What is left of the mesh when triangles without area in the world are gone.
void dropEmptyTriangles(scene::Mesh& mesh, const mat3& world)
{
    size_t kept = 0;
    for (size_t i = 0; i < mesh.triangleMaterials.size(); ++i) {
        const uint32_t* corners = &mesh.indices[3 * i];
        if (!hasArea({world * mesh.positions[corners[0]], world * mesh.positions[corners[1]], world * mesh.positions[corners[2]]}))
            continue;
        std::copy_n(corners, 3, &mesh.indices[3 * kept]);
        mesh.triangleMaterials[kept++] = mesh.triangleMaterials[i];
    }
    mesh.indices.resize(3 * kept);
    mesh.triangleMaterials.resize(kept);
}

/// Adds the other side of triangles of two-sided materials, with vertices of its own. True where there are any.
bool addTurnedOver(scene::Mesh& mesh, const std::vector<scene::Material>& materials)
{
    const size_t triangleCount = mesh.triangleMaterials.size();
    const size_t vertexCount = mesh.positions.size();
    std::vector<uint32_t> copies(vertexCount, scene::kNoIndex);
    const auto copyOf = [&](uint32_t vertex) {
        if (copies[vertex] == scene::kNoIndex) {
            copies[vertex] = static_cast<uint32_t>(mesh.positions.size());
            mesh.positions.push_back(vec3(mesh.positions[vertex]));
            mesh.normals.push_back(-mesh.normals[vertex]);
            mesh.uvs.push_back(vec2(mesh.uvs[vertex]));
        }
        return copies[vertex];
    };
    for (size_t i = 0; i < triangleCount; ++i) {
        if (!materials[mesh.triangleMaterials[i]].twoSided)
            continue;
        for (const size_t corner : {0, 2, 1})
            mesh.indices.push_back(copyOf(mesh.indices[3 * i + corner]));
        mesh.triangleMaterials.push_back(uint32_t{mesh.triangleMaterials[i]});
    }
    return mesh.positions.size() > vertexCount;
}

/// The places of the mesh's vertices in the world, but for its translation, from the lowest x on; sets the place of every vertex in use.
std::vector<vec3> placesOf(const scene::Mesh& mesh, const mat3& world, std::vector<uint32_t>& placeOfVertex)
{
    std::vector<vec3> positions(mesh.positions.size());
    std::vector<uint32_t> used = mesh.indices;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const uint32_t vertex : used)
        positions[vertex] = world * mesh.positions[vertex] + 0.0f; // no negative zeros
    std::ranges::sort(used, [&](uint32_t a, uint32_t b) {
        const vec3 p = positions[a], q = positions[b];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    });
    std::vector<vec3> places;
    placeOfVertex.assign(positions.size(), scene::kNoIndex);
    for (const uint32_t vertex : used) {
        if (places.empty() || places.back() != positions[vertex])
            places.push_back(positions[vertex]);
        placeOfVertex[vertex] = static_cast<uint32_t>(places.size() - 1);
    }
    return places;
}

/// The mesh's triangles by where they are, whose order becomes that of the mesh.
Surface sortedSurface(scene::Mesh& mesh, const mat3& world)
{
    struct Triangle
    {
        std::array<uint32_t, 3> places, vertices;
        uint32_t material;
    };
    std::vector<uint32_t> placeOfVertex;
    Surface surface{placesOf(mesh, world, placeOfVertex), {}};
    std::vector<Triangle> triangles(mesh.triangleMaterials.size());
    for (size_t i = 0; i < triangles.size(); ++i) {
        const uint32_t* corners = &mesh.indices[3 * i];
        const size_t first = static_cast<size_t>(
            std::ranges::min_element(corners, corners + 3, {}, [&](uint32_t vertex) { return placeOfVertex[vertex]; }) - corners);
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t vertex = corners[(first + corner) % 3];
            triangles[i].vertices[corner] = vertex;
            triangles[i].places[corner] = placeOfVertex[vertex];
        }
        triangles[i].material = mesh.triangleMaterials[i];
    }
    std::ranges::stable_sort(triangles, [](const Triangle& a, const Triangle& b) {
        return a.places != b.places ? a.places < b.places : a.material < b.material;
    });
    for (size_t i = 0; i < triangles.size(); ++i) {
        std::ranges::copy(triangles[i].vertices, &mesh.indices[3 * i]);
        surface.indices.insert(surface.indices.end(), triangles[i].places.begin(), triangles[i].places.end());
        mesh.triangleMaterials[i] = triangles[i].material;
    }
    return surface;
}

/// The mesh's own coordinates as one chart, upright as they are, at the scale of its surface.
Chart chartOfBakeUvs(const scene::Mesh& mesh, const Surface& surface)
{
    Chart chart;
    chart.triangles.resize(mesh.triangleMaterials.size());
    std::iota(chart.triangles.begin(), chart.triangles.end(), 0u);
    for (const uint32_t vertex : mesh.indices)
        chart.corners.push_back(mesh.bakeUvs[vertex]);
    scaleToSurface(chart, surface);
    vec2 lowest = chart.corners.front();
    for (const vec2 corner : chart.corners)
        lowest = glm::min(lowest, corner);
    for (vec2& corner : chart.corners) {
        corner -= lowest;
        chart.extent = glm::max(chart.extent, corner);
    }
    return chart;
}

ChartedMesh chartedMesh(const AtlasObject& object)
{
    const mat3 world(object.world);
    ChartedMesh charted{scene::restMesh(*object.model), {}};
    scene::Mesh& mesh = charted.mesh;
    dropEmptyTriangles(mesh, world);
    const bool isDoubled = addTurnedOver(mesh, object.model->materials);
    const Surface surface = sortedSurface(mesh, world);
    if (mesh.indices.empty())
        return charted;
    if (!isDoubled && faultOfBakeUvs(mesh) == nullptr)
        charted.charts.push_back(chartOfBakeUvs(mesh, surface));
    else
        charted.charts = chartsOf(surface);
    return charted;
}

/// How far a chart reaches on the page, in texels. What is small or narrow is bent or lies in corners, where light changes quickly: a
/// side of few texels gets up to kMostFine times as many.
vec2 reachOf(const Chart& chart, float texelsPerMetre)
{
    const vec2 even = chart.extent * texelsPerMetre;
    return glm::max(even, glm::min(kMostFine * even, vec2(kFewTexels)));
}

/// Texels that a chart covers: one at least, and no more than can be counted.
uvec2 texelsOf(const Chart& chart, float texelsPerMetre)
{
    constexpr float kRounding = 1.0e-3f;
    constexpr float kCountable = 1 << 20;
    return uvec2(glm::clamp(glm::ceil(reachOf(chart, texelsPerMetre) - kRounding), vec2(1), vec2(kCountable)));
}

std::vector<uvec2> rectanglesFor(const std::vector<ChartedMesh>& meshes, float texelsPerMetre)
{
    std::vector<uvec2> rectangles;
    for (const ChartedMesh& mesh : meshes)
        for (const Chart& chart : mesh.charts)
            rectangles.push_back(texelsOf(chart, texelsPerMetre) + 2 * kMargin);
    return rectangles;
}

/// The greatest at which all charts find a place, or what was asked.
float densityThatFits(const std::vector<ChartedMesh>& meshes, const AtlasSettings& settings)
{
    const auto isEnough = [&](float texelsPerMetre) { return fits(rectanglesFor(meshes, texelsPerMetre), settings.mostTexels); };
    const float asked = settings.texelsPerMetre;
    if (isEnough(asked))
        return asked;
    const std::string subject = fmt::format("an atlas of {0} x {0} texels", settings.mostTexels);
    float fitting = asked * kHopelessShare;
    if (!isEnough(fitting))
        throw Error{"has no room for all charts, at no density", subject};
    for (float tooDense = asked; tooDense > kDensityStep * fitting;) {
        const float middle = std::sqrt(fitting * tooDense);
        (isEnough(middle) ? fitting : tooDense) = middle;
    }
    if (fitting < kLeastShare * asked)
        throw Error{fmt::format("has room for all charts at {:.3g} texels a metre, not at {:g}", fitting, asked), subject};
    return fitting;
}

/// The mesh with vertices split where charts part, in the order of its charts. `bakeUvs`: one a corner of every chart's triangles.
scene::Mesh splitAtSeams(const ChartedMesh& charted, std::span<const vec2> bakeUvs)
{
    const scene::Mesh& mesh = charted.mesh;
    scene::Mesh split;
    std::vector<uint32_t> copies(mesh.positions.size());
    std::vector<uint32_t> chartsOfCopies(mesh.positions.size(), scene::kNoIndex);
    size_t next = 0;
    for (uint32_t chart = 0; chart < charted.charts.size(); ++chart)
        for (const uint32_t triangle : charted.charts[chart].triangles) {
            for (size_t corner = 0; corner < 3; ++corner, ++next) {
                const uint32_t vertex = mesh.indices[3 * triangle + corner];
                if (chartsOfCopies[vertex] != chart) {
                    chartsOfCopies[vertex] = chart;
                    copies[vertex] = static_cast<uint32_t>(split.positions.size());
                    split.positions.push_back(mesh.positions[vertex]);
                    split.normals.push_back(mesh.normals[vertex]);
                    split.uvs.push_back(mesh.uvs[vertex]);
                    split.bakeUvs.push_back(bakeUvs[next]);
                }
                split.indices.push_back(copies[vertex]);
            }
            split.triangleMaterials.push_back(mesh.triangleMaterials[triangle]);
        }
    scene::orderTriangles(split, split.positions);
    return split;
}

/// Where the chart's corners come to lie on the page, 0..1: in the middle of its texels.
void appendPlaced(std::vector<vec2>& bakeUvs, const Chart& chart, uvec2 corner, const Atlas& atlas)
{
    constexpr float kLeastTexels = 1.0f / 16; // thinner than that, coordinates would coincide
    const vec2 texels(texelsOf(chart, atlas.texelsPerMetre));
    const vec2 covered = glm::clamp(reachOf(chart, atlas.texelsPerMetre), vec2(kLeastTexels), texels);
    const vec2 texelsPerMetre = covered / glm::max(chart.extent, vec2(std::numeric_limits<float>::min()));
    const vec2 start = vec2(corner + kMargin) + 0.5f * (texels - covered);
    for (const vec2 place : chart.corners)
        bakeUvs.push_back((start + place * texelsPerMetre) / vec2(atlas.extent));
}

} // namespace

Atlas layOut(std::span<const AtlasObject> objects, const AtlasSettings& settings)
{
    check(settings.texelsPerMetre > 0, "a density above zero");
    std::vector<ChartedMesh> meshes;
    for (const AtlasObject& object : objects)
        meshes.push_back(chartedMesh(object));

    Atlas atlas;
    atlas.texelsPerMetre = densityThatFits(meshes, settings);
    const std::optional<Packing> packing = pack(rectanglesFor(meshes, atlas.texelsPerMetre), settings.mostTexels);
    check(packing.has_value(), "a page for what fits");
    atlas.extent = packing->page;
    auto corner = packing->corners.begin();
    for (const ChartedMesh& mesh : meshes) {
        std::vector<vec2> bakeUvs;
        for (const Chart& chart : mesh.charts)
            appendPlaced(bakeUvs, chart, *corner++, atlas);
        atlas.meshes.push_back(splitAtSeams(mesh, bakeUvs));
    }
    return atlas;
}

} // namespace antumbra::bake
