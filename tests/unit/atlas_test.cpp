#include "bake/atlas.h"

#include "base/error.h"
#include "scene/gltf.h"
#include "unit/atlas_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace antumbra::bake {
namespace {

using scene::Mesh;
using scene::Model;

Model modelOf(Mesh mesh, bool isTwoSided = false) { return scene::rigidModel("model", std::move(mesh), {.twoSided = isTwoSided}); }

Atlas layOutOne(const Model& model, const AtlasSettings& settings = {}, const mat4& world = mat4(1))
{
    return layOut(std::array{AtlasObject{&model, world}}, settings);
}

/// A square of side 1 in two triangles that share vertices, with bake coordinates as given.
Mesh squareWith(std::vector<vec2> bakeUvs)
{
    Mesh mesh = scene::makePlane();
    mesh.bakeUvs = std::move(bakeUvs);
    return mesh;
}

/// A winding ramp, 1 m wide around a well of 1 m, that rises by half a metre a turn.
Mesh ramp(uint32_t steps, uint32_t stepsPerTurn)
{
    Mesh mesh;
    for (uint32_t i = 0; i <= steps; ++i)
        for (const float radius : {1.0f, 2.0f}) {
            const float turns = static_cast<float>(i) / static_cast<float>(stepsPerTurn);
            mesh.positions.emplace_back(radius * std::cos(2 * kPi * turns), 0.5f * turns, -radius * std::sin(2 * kPi * turns));
            mesh.normals.emplace_back(0, 1, 0);
            mesh.uvs.emplace_back(0);
        }
    for (uint32_t i = 0; i < 2 * steps; i += 2)
        for (const uint32_t corner : {i, i + 1, i + 3, i, i + 3, i + 2})
            mesh.indices.push_back(corner);
    mesh.triangleMaterials.assign(2 * steps, 0);
    return mesh;
}

/// The same triangles with vertices, triangles and the corners of triangles in another order.
Mesh shuffled(const Mesh& mesh)
{
    std::mt19937 random(3);
    std::vector<uint32_t> vertices(mesh.positions.size()), triangles(mesh.triangleMaterials.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::iota(triangles.begin(), triangles.end(), 0u);
    std::ranges::shuffle(vertices, random);
    std::ranges::shuffle(triangles, random);
    Mesh result;
    std::vector<uint32_t> newPlaces(vertices.size());
    for (const uint32_t vertex : vertices) {
        newPlaces[vertex] = static_cast<uint32_t>(result.positions.size());
        result.positions.push_back(mesh.positions[vertex]);
        result.normals.push_back(mesh.normals[vertex]);
        result.uvs.push_back(mesh.uvs[vertex]);
    }
    for (const uint32_t triangle : triangles) {
        const size_t turn = random() % 3;
        for (size_t corner = 0; corner < 3; ++corner)
            result.indices.push_back(newPlaces[mesh.indices[3 * triangle + (corner + turn) % 3]]);
        result.triangleMaterials.push_back(mesh.triangleMaterials[triangle]);
    }
    return result;
}

void expectSame(const Atlas& a, const Atlas& b)
{
    EXPECT_EQ(a.extent, b.extent);
    EXPECT_EQ(a.texelsPerMetre, b.texelsPerMetre);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (size_t i = 0; i < a.meshes.size(); ++i) {
        EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
        EXPECT_EQ(a.meshes[i].normals, b.meshes[i].normals);
        EXPECT_EQ(a.meshes[i].bakeUvs, b.meshes[i].bakeUvs);
        EXPECT_EQ(a.meshes[i].indices, b.meshes[i].indices);
    }
}

const std::vector<vec2> kSoundUvs{{0.1f, 0.2f}, {0.9f, 0.2f}, {0.9f, 0.6f}, {0.1f, 0.6f}};

} // namespace

TEST(BakeUvs, FaultsAreNamed)
{
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(faultOfBakeUvs(squareWith(kSoundUvs)), nullptr);
    EXPECT_STREQ(faultOfBakeUvs(squareWith({})), "there are no coordinates");
    EXPECT_STREQ(faultOfBakeUvs(squareWith({{0, 0}, {1.01f, 0}, {1, 1}, {0, 1}})), "coordinates lie outside 0..1");
    EXPECT_STREQ(faultOfBakeUvs(squareWith({{0, 0}, {1, -0.01f}, {1, 1}, {0, 1}})), "coordinates lie outside 0..1");
    EXPECT_STREQ(faultOfBakeUvs(squareWith({{0, 0}, {1, kNan}, {1, 1}, {0, 1}})), "coordinates lie outside 0..1");
    EXPECT_STREQ(faultOfBakeUvs(squareWith({{0, 0}, {1, 0}, {0.5f, 0}, {0, 1}})), "triangles have no area");
    EXPECT_STREQ(faultOfBakeUvs(squareWith({{0, 0}, {1, 0}, {1, 1}, {0.9f, 0.5f}})), "triangles overlap");
}

TEST(BakeUvs, SoundOnesAreKeptToScale)
{
    const Model model = modelOf(squareWith(kSoundUvs));
    const Atlas atlas = layOutOne(model, {.texelsPerMetre = 50});
    expectSound(atlas, 1, {.texelsPerMetre = 50});
    const Mesh& mesh = atlas.meshes[0];
    ASSERT_EQ(mesh.positions.size(), 4);
    // Twice as wide as high, as in the file, with the area of the square.
    for (size_t i = 0; i < 4; ++i)
        for (size_t k = 0; k < 4; ++k) {
            const vec2 place = mesh.positions[i].x * vec2(1, 0) - mesh.positions[i].z * vec2(0, 1);
            const vec2 other = mesh.positions[k].x * vec2(1, 0) - mesh.positions[k].z * vec2(0, 1);
            const vec2 expected = (place - other) * 50.0f * vec2(std::sqrt(2.0f), std::sqrt(0.5f));
            EXPECT_LT(glm::distance((mesh.bakeUvs[i] - mesh.bakeUvs[k]) * vec2(atlas.extent), expected), 1.0e-3f);
        }
}

TEST(BakeUvs, FaultyOnesAndTwoSidedMeshesAreCharted)
{
    const Model faulty = modelOf(squareWith({{0, 0}, {1, 0}, {1, 1}, {0.9f, 0.5f}}));
    const Model twoSided = modelOf(squareWith(kSoundUvs), true);
    for (const Model* model : {&faulty, &twoSided}) {
        const Atlas atlas = layOutOne(*model);
        expectSound(atlas, 1, {});
        expectEvenDensity(atlas, atlas.meshes[0]);
    }
}

TEST(Atlas, OfShapesIsSoundAndEven)
{
    const Model plane = modelOf(scene::makePlane()), cube = modelOf(scene::makeCube()), sphere = modelOf(scene::makeSphere());
    const std::array objects{AtlasObject{&plane}, AtlasObject{&cube}, AtlasObject{&sphere}, AtlasObject{&cube}};
    for (const float texelsPerMetre : {3.0f, 10.0f, 31.7f, 100.0f}) {
        const AtlasSettings settings{.texelsPerMetre = texelsPerMetre};
        const Atlas atlas = layOut(objects, settings);
        expectSound(atlas, objects.size(), settings);
        EXPECT_EQ(atlas.texelsPerMetre, texelsPerMetre);
        for (const Mesh& mesh : atlas.meshes)
            expectEvenDensity(atlas, mesh);
        EXPECT_EQ(chartCount(atlas.meshes[0]), 1);
        EXPECT_EQ(chartCount(atlas.meshes[1]), 6);
        EXPECT_LE(chartCount(atlas.meshes[2]), 60);
    }
}

TEST(Atlas, SplitsVerticesAtSeamsOnly)
{
    Mesh cube;
    for (uint32_t i = 0; i < 8; ++i) {
        cube.positions.push_back(vec3(i & 1, i >> 1 & 1, i >> 2) - 0.5f);
        cube.normals.push_back(glm::normalize(cube.positions.back()));
        cube.uvs.emplace_back(0);
    }
    cube.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    cube.triangleMaterials.assign(12, 0);
    const Model model = modelOf(cube);
    const Atlas atlas = layOutOne(model);
    expectSound(atlas, 1, {});
    EXPECT_EQ(atlas.meshes[0].positions.size(), 24);
    EXPECT_EQ(atlas.meshes[0].triangleMaterials.size(), 12);
}

TEST(Atlas, GivesTwoSidedTrianglesBothSides)
{
    const Model model = modelOf(scene::makePlane(), true);
    const Atlas atlas = layOutOne(model);
    expectSound(atlas, 1, {});
    const Mesh& mesh = atlas.meshes[0];
    ASSERT_EQ(mesh.triangleMaterials.size(), 4);
    EXPECT_EQ(chartCount(mesh), 2);
    int up = 0;
    for (size_t i = 0; i < 12; i += 3) {
        const vec3 a = mesh.positions[mesh.indices[i]];
        const vec3 normal = glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        EXPECT_GT(glm::dot(normal, mesh.normals[mesh.indices[i]]), 0);
        up += normal.y > 0 ? 1 : -1;
    }
    EXPECT_EQ(up, 0);
}

TEST(Atlas, LeavesOutTrianglesWithoutArea)
{
    Mesh mesh = scene::makeCube();
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const float x : {0.0f, 1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        mesh.positions.emplace_back(x, 7, 7);
        mesh.normals.emplace_back(0, 1, 0);
        mesh.uvs.emplace_back(0);
    }
    for (const uint32_t corner : {0u, 1u, 2u, 0u, 0u, 1u, 1u, 2u, 3u, 4u, 1u, 2u})
        mesh.indices.push_back(first + corner);
    mesh.triangleMaterials.insert(mesh.triangleMaterials.end(), 4, 0);
    const Model model = modelOf(mesh);
    const Atlas atlas = layOutOne(model);
    expectSound(atlas, 1, {});
    EXPECT_EQ(atlas.meshes[0].triangleMaterials.size(), 12);
    EXPECT_EQ(atlas.meshes[0].positions.size(), 24);
    expectSame(atlas, layOutOne(modelOf(scene::makeCube())));
}

TEST(Atlas, OfNothingIsAnEmptyPage)
{
    const Model empty = modelOf({});
    const Atlas atlas = layOutOne(empty);
    expectSound(atlas, 1, {});
    EXPECT_TRUE(atlas.meshes[0].indices.empty());
    expectSound(layOut({}, {}), 0, {});
    // What is flattened in the world has no area there, but for what lies in the plane.
    const Model cube = modelOf(scene::makeCube());
    EXPECT_EQ(layOutOne(cube, {}, glm::scale(mat4(1), vec3(1, 0, 1))).meshes[0].triangleMaterials.size(), 4);
}

TEST(Atlas, GivesNarrowChartsMoreTexels)
{
    const Model plane = modelOf(scene::makePlane());
    const auto sidesOf = [&](vec2 metres, float texelsPerMetre) {
        const Atlas atlas = layOutOne(plane, {.texelsPerMetre = texelsPerMetre}, glm::scale(mat4(1), vec3(metres.x, 1, metres.y)));
        vec2 lowest(1), highest(0);
        for (const vec2 uv : atlas.meshes[0].bakeUvs) {
            lowest = glm::min(lowest, uv);
            highest = glm::max(highest, uv);
        }
        const vec2 sides = (highest - lowest) * vec2(atlas.extent);
        return vec2(std::max(sides.x, sides.y), std::min(sides.x, sides.y));
    };
    const auto expectSides = [&](vec2 metres, float texelsPerMetre, vec2 expected) {
        const vec2 sides = sidesOf(metres, texelsPerMetre);
        EXPECT_NEAR(sides.x, expected.x, 1e-3) << metres.x << " x " << metres.y;
        EXPECT_NEAR(sides.y, expected.y, 1e-3) << metres.x << " x " << metres.y;
    };
    expectSides({10, 2}, 8, {80, 16}); // as asked
    expectSides({10, 0.5f}, 8, {80, 4});
    expectSides({10, 0.25f}, 8, {80, 4});    // two would be
    expectSides({10, 0.05f}, 8, {80, 1.6f}); // four times as many, and no more
    expectSides({0.1f, 0.1f}, 8, {3.2f, 3.2f});
}

TEST(Atlas, GivesTheSmallestChartsATexel)
{
    const Model cube = modelOf(scene::makeCube());
    std::vector<AtlasObject> objects;
    for (const float edge : {0.1f, 1.0e-3f, 1.0e-8f})
        objects.insert(objects.end(), 20, {&cube, glm::scale(mat4(1), vec3(edge))});
    const Atlas atlas = layOut(objects, {});
    expectSound(atlas, objects.size(), {});
    const std::vector<uint32_t> page = paintCharts(atlas);
    const int texelsOfThree = 4 * 4 + 1 + 1; // 3.2 x 3.2, and hardly any
    EXPECT_EQ(std::ranges::count_if(page, [](uint32_t chart) { return chart != kNoChart; }), 20 * 6 * texelsOfThree);
    for (size_t i = 0; i < objects.size(); ++i)
        EXPECT_GT(densities(atlas, atlas.meshes[i], objects[i].world).narrow.front(), 0) << "coordinates coincide";
}

TEST(Atlas, MeasuresTexelsInTheWorld)
{
    const Model sphere = modelOf(scene::makeSphere());
    for (const vec3 scale : {vec3(3), vec3(-2, 2, 2), vec3(1, 4, 0.5f)}) {
        const mat4 world = glm::rotate(glm::translate(mat4(1), vec3(100, 5, -3)), 0.7f, vec3(0.6f, 0, 0.8f)) * glm::scale(mat4(1), scale);
        const Atlas atlas = layOutOne(sphere, {.texelsPerMetre = 20}, world);
        expectSound(atlas, 1, {.texelsPerMetre = 20});
        expectEvenDensity(atlas, atlas.meshes[0], world);
    }
}

TEST(Atlas, TakesALowerDensityWhereThePageIsFull)
{
    const Model cube = modelOf(scene::makeCube());
    const AtlasSettings settings{.texelsPerMetre = 100, .mostTexels = 128};
    const Atlas atlas = layOutOne(cube, settings);
    expectSound(atlas, 1, settings);
    EXPECT_GT(atlas.texelsPerMetre, 38); // three rows of two faces of 40 texels and gutters
    EXPECT_LT(atlas.texelsPerMetre, 45);
    expectEvenDensity(atlas, atlas.meshes[0]);
}

TEST(Atlas, RefusesWhatFitsAtNoDensityWorthHaving)
{
    const Model cube = modelOf(scene::makeCube());
    const auto messageFor = [&](uint32_t mostTexels) {
        try {
            layOutOne(cube, {.texelsPerMetre = 1000, .mostTexels = mostTexels});
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(messageFor(32), testing::MatchesRegex("an atlas of 32 x 32 texels: .* at 7.* texels a metre.*"));
    EXPECT_THAT(messageFor(4), testing::HasSubstr("at no density"));
    EXPECT_THAT(messageFor(1024), testing::IsEmpty());
}

TEST(Atlas, DoesNotDependOnTheOrderOfTheMesh)
{
    const Mesh sphere = scene::makeSphere();
    const Model model = modelOf(sphere, true), other = modelOf(shuffled(sphere), true);
    expectSame(layOutOne(model), layOutOne(model));
    expectSame(layOutOne(model), layOutOne(other));
}

TEST(Atlas, CutsWhatWindsOverItself)
{
    const Model model = modelOf(ramp(100, 40));
    const Atlas atlas = layOutOne(model);
    expectSound(atlas, 1, {});
    expectEvenDensity(atlas, atlas.meshes[0]);
    EXPECT_GE(chartCount(atlas.meshes[0]), 3);
    EXPECT_LE(chartCount(atlas.meshes[0]), 6);
}

TEST(Atlas, OfTheAtriumIsSoundFullAndEven)
{
    const Model model = scene::loadGltf(projectPath("assets") / "scenes/atrium_small.glb");
    const std::array objects{AtlasObject{&model}};
    const Atlas atlas = layOut(objects, {});
    EXPECT_GT(expectSound(atlas, objects.size(), {}), 0.6);
    EXPECT_LT(chartCount(atlas.meshes[0]), 2500);
    EXPECT_EQ(atlas.texelsPerMetre, 8);
    const std::vector<float> shares = densities(atlas, atlas.meshes[0]).wide;
    ASSERT_GT(shares.size(), 1000u);
    EXPECT_GT(shares[shares.size() / 100], 0.8f);
    EXPECT_LT(shares[shares.size() - shares.size() / 100], 1.25f);
    Model other = model;
    other.mesh = shuffled(model.mesh);
    other.mesh.influences = model.mesh.influences;
    expectSame(atlas, layOutOne(other));
}

TEST(Atlas, OfTheLargeAtriumFitsThePageOfThePaper)
{
    const Path file = Path(ANTUMBRA_SHARED_DIR) / "assets/scenes/atrium_large.glb";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is absent";
    const Model model = scene::loadGltf(file);
    const std::array objects{AtlasObject{&model}};
    const AtlasSettings settings{.texelsPerMetre = 64, .mostTexels = 2048};
    const Atlas atlas = layOut(objects, settings);
    EXPECT_GT(expectSound(atlas, objects.size(), settings), 0.75);
    EXPECT_GT(atlas.texelsPerMetre, 24);
}

} // namespace antumbra::bake
