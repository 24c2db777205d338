#include "scene/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

/// Six times the signed volume by the divergence theorem: positive when the triangles wind counter-clockwise seen from outside.
double volumeOf(const Mesh& mesh)
{
    double sixfold = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const vec3 a = mesh.positions[mesh.indices[i]];
        const vec3 b = mesh.positions[mesh.indices[i + 1]];
        const vec3 c = mesh.positions[mesh.indices[i + 2]];
        sixfold += glm::dot(a, glm::cross(b, c));
    }
    return sixfold / 6;
}

void expectWholeStreams(const Mesh& mesh)
{
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
    EXPECT_EQ(mesh.triangleMaterials.size() * 3, mesh.indices.size());
    for (const vec3& normal : mesh.normals)
        EXPECT_NEAR(glm::length(normal), 1, 1e-5);
}

/// Small triangles at the points of a grid, in random order; triangle i has the material i.
Mesh shuffledGrid(uint32_t side)
{
    std::vector<uint32_t> cells(side * side);
    std::iota(cells.begin(), cells.end(), 0u);
    std::shuffle(cells.begin(), cells.end(), std::mt19937(7));
    Mesh mesh;
    for (const uint32_t cell : cells) {
        const vec3 corner(cell % side, 0, cell / side);
        for (const vec3 offset : {vec3{0}, vec3{0, 0, 0.5f}, vec3{0.5f, 0, 0}}) {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(corner + offset);
        }
        mesh.triangleMaterials.push_back(cell);
    }
    return mesh;
}

/// The summed box areas of the tree that a builder makes who halves the buffer.
double halvingCost(const Mesh& mesh, size_t first, size_t last)
{
    Aabb box;
    for (size_t i = 3 * first; i < 3 * last + 3; ++i)
        box.add(mesh.positions[mesh.indices[i]]);
    if (first == last)
        return box.surfaceArea();
    const size_t middle = (first + last) / 2;
    return box.surfaceArea() + halvingCost(mesh, first, middle) + halvingCost(mesh, middle + 1, last);
}

} // namespace

TEST(Mesh, PlaneIsOneMetreAndFacesUp)
{
    const Mesh plane = makePlane();
    expectWholeStreams(plane);
    EXPECT_EQ(plane.bounds().extent(), vec3(1, 0, 1));
    for (size_t i = 0; i < plane.indices.size(); i += 3) {
        const vec3 a = plane.positions[plane.indices[i]];
        const vec3 faceNormal = glm::cross(plane.positions[plane.indices[i + 1]] - a, plane.positions[plane.indices[i + 2]] - a);
        EXPECT_GT(faceNormal.y, 0);
    }
    for (const vec3& normal : plane.normals)
        EXPECT_EQ(normal, vec3(0, 1, 0));
}

TEST(Mesh, CubeIsClosedAndFacesOutwards)
{
    const Mesh cube = makeCube();
    expectWholeStreams(cube);
    EXPECT_EQ(cube.bounds().extent(), vec3(1));
    EXPECT_EQ(cube.indices.size(), 36u);
    EXPECT_NEAR(volumeOf(cube), 1, 1e-6);
    for (size_t i = 0; i < cube.positions.size(); ++i)
        EXPECT_NEAR(glm::dot(cube.positions[i], cube.normals[i]), 0.5f, 1e-6);
}

TEST(Mesh, SphereApproachesItsVolumeFromInside)
{
    const Mesh sphere = makeSphere();
    expectWholeStreams(sphere);
    const double exact = 4.0 / 3 * std::numbers::pi * 0.125;
    EXPECT_LT(volumeOf(sphere), exact);
    EXPECT_GT(volumeOf(sphere), 0.985 * exact);
    for (size_t i = 0; i < sphere.positions.size(); ++i)
        EXPECT_NEAR(glm::dot(sphere.positions[i], sphere.normals[i]), 0.5f, 1e-5);
}

TEST(Mesh, OrderingKeepsTrianglesAndTheirMaterials)
{
    Mesh mesh = shuffledGrid(17);
    orderTriangles(mesh, mesh.positions);
    std::vector<bool> seen(17 * 17);
    for (size_t i = 0; i < mesh.triangleMaterials.size(); ++i) {
        const uint32_t cell = mesh.triangleMaterials[i];
        EXPECT_FALSE(seen[cell]);
        seen[cell] = true;
        EXPECT_EQ(mesh.positions[mesh.indices[3 * i]], vec3(cell % 17, 0, cell / 17));
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 17 * 17);
}

TEST(Mesh, OrderingMakesHalvesCompact)
{
    Mesh mesh = shuffledGrid(32);
    const double before = halvingCost(mesh, 0, 1023);
    orderTriangles(mesh, mesh.positions);
    const double after = halvingCost(mesh, 0, 1023);
    // A grid of 32 x 32 cells split at its middles: 11 levels of about twice the grid's area each.
    EXPECT_LT(after, 11 * 2 * 32 * 32);
    EXPECT_GT(before, 2 * after);
}

TEST(Mesh, OrderingPutsTheLargerHalfFirst)
{
    // Three triangles left, two right: the builder puts (0 + 4) / 2 = 2 and all before it to the left.
    Mesh mesh;
    for (const float x : {10.0f, 0.0f, 11.0f, 1.0f, 2.0f})
        for (const vec3 offset : {vec3{0}, vec3{0.1f, 0, 0}, vec3{0, 0.1f, 0}}) {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(vec3{x, 0, 0} + offset);
        }
    mesh.triangleMaterials = {10, 0, 11, 1, 2};
    orderTriangles(mesh, mesh.positions);
    const auto middle = mesh.triangleMaterials.begin() + 3;
    EXPECT_TRUE(std::all_of(mesh.triangleMaterials.begin(), middle, [](uint32_t x) { return x < 10; }));
    EXPECT_TRUE(std::all_of(middle, mesh.triangleMaterials.end(), [](uint32_t x) { return x >= 10; }));
}

TEST(Mesh, OrderingLooksAtTheRestPose)
{
    // All vertices coincide in bind space; only the rest pose tells them apart.
    Mesh mesh = shuffledGrid(16);
    const std::vector<vec3> rest = mesh.positions;
    std::fill(mesh.positions.begin(), mesh.positions.end(), vec3{0});
    orderTriangles(mesh, rest);
    mesh.positions = rest;
    Mesh ordered = shuffledGrid(16);
    orderTriangles(ordered, ordered.positions);
    EXPECT_EQ(mesh.indices, ordered.indices);
}

TEST(Mesh, OrderingTakesEmptyAndHugeMeshes)
{
    Mesh empty;
    orderTriangles(empty, empty.positions);
    EXPECT_TRUE(empty.indices.empty());
    Mesh huge = shuffledGrid(4);
    for (vec3& position : huge.positions)
        position *= 1e37f;
    orderTriangles(huge, huge.positions);
    EXPECT_EQ(huge.indices.size(), 48u);
}
