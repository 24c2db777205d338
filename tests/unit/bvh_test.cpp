#include "render/shadow/bvh.h"

#include "base/bounds.h"
#include "scene/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

namespace antumbra::render {
namespace {

using scene::Mesh;
using shader::BvhNode;

/// Small triangles here and there, in the loader's order.
Mesh scattered(uint32_t triangleCount)
{
    std::mt19937 random(triangleCount);
    const auto next = [&random] { return static_cast<float>(random()) * 0x1p-32f; };
    Mesh mesh;
    for (uint32_t i = 0; i < triangleCount; ++i) {
        const vec3 at(10 * next(), 10 * next(), 10 * next());
        for (uint32_t corner = 0; corner < 3; ++corner) {
            mesh.indices.push_back(3 * i + corner);
            mesh.positions.push_back(at + vec3(next(), next(), next()));
        }
    }
    mesh.triangleMaterials.resize(triangleCount);
    orderTriangles(mesh, mesh.positions);
    return mesh;
}

std::vector<BvhNode> treeOf(const Mesh& mesh) { return bvhOf(mesh.positions, mesh.indices); }

bool holds(const BvhNode& node, vec3 point)
{
    return glm::all(glm::lessThanEqual(node.lowest, point)) && glm::all(glm::lessThanEqual(point, node.highest));
}

/// The sum of the areas of all boxes: what rays pay on average (MacDonald and Booth 1990).
double costOf(const std::vector<BvhNode>& nodes)
{
    double cost = 0;
    for (size_t i = 1; i < nodes.size(); ++i)
        cost += Aabb{nodes[i].lowest, nodes[i].highest}.surfaceArea();
    return cost;
}

TEST(Bvh, IsAPerfectTreeNoDeeperThanTheLogarithmOfItsTriangles)
{
    for (uint32_t count = 0; count < 5000; ++count) {
        const uint32_t leaves = bvhLeafCount(count);
        ASSERT_TRUE(std::has_single_bit(leaves)) << count;
        ASSERT_GE(leaves * shader::kBvhLeafTriangles, count);
        ASSERT_LE(leaves, std::max(count, 1u)) << "a leaf has nothing to hold";
    }
    EXPECT_EQ(bvhLeafCount(1u << 30), 1u << 28);
}

TEST(Bvh, HoldsEveryTriangleInExactlyOneLeaf)
{
    for (const uint32_t count : {1u, 2u, 4u, 5u, 7u, 8u, 9u, 63u, 64u, 65u, 1000u, 3201u}) {
        SCOPED_TRACE(count);
        const Mesh mesh = scattered(count);
        const std::vector<BvhNode> nodes = treeOf(mesh);
        ASSERT_EQ(nodes.size(), 2 * bvhLeafCount(count));
        uint32_t next = 0;
        for (size_t leaf = nodes.size() / 2; leaf < nodes.size(); ++leaf) {
            EXPECT_EQ(nodes[leaf].firstTriangle, next);
            EXPECT_GE(nodes[leaf].triangleCount, 1u);
            EXPECT_LE(nodes[leaf].triangleCount, shader::kBvhLeafTriangles);
            next += nodes[leaf].triangleCount;
        }
        EXPECT_EQ(next, count);
    }
}

TEST(Bvh, BoxesHoldWhatIsBelow)
{
    const Mesh mesh = scattered(777);
    const std::vector<BvhNode> nodes = treeOf(mesh);
    const size_t leafCount = nodes.size() / 2;
    for (size_t leaf = leafCount; leaf < nodes.size(); ++leaf)
        for (uint32_t i = 0; i < 3 * nodes[leaf].triangleCount; ++i)
            EXPECT_TRUE(holds(nodes[leaf], mesh.positions[mesh.indices[3 * nodes[leaf].firstTriangle + i]]));
    for (size_t node = 1; node < leafCount; ++node)
        for (const size_t child : {2 * node, 2 * node + 1}) {
            EXPECT_TRUE(holds(nodes[node], nodes[child].lowest) && holds(nodes[node], nodes[child].highest));
            EXPECT_EQ(nodes[node].triangleCount, 0u);
        }
    EXPECT_EQ(nodes[1].lowest, mesh.bounds().lowest);
    EXPECT_EQ(nodes[1].highest, mesh.bounds().highest);
}

TEST(Bvh, TakesItsQualityFromTheLoadersOrder)
{
    Mesh mesh = scattered(2000);
    const double ordered = costOf(treeOf(mesh));
    std::vector<uint32_t> triangles(2000);
    std::ranges::generate(triangles, [i = 0u]() mutable { return i++; });
    std::ranges::shuffle(triangles, std::mt19937(5));
    Mesh shuffled = mesh;
    for (size_t i = 0; i < triangles.size(); ++i)
        std::copy_n(&mesh.indices[3 * size_t{triangles[i]}], 3, &shuffled.indices[3 * i]);
    EXPECT_LT(3 * ordered, costOf(treeOf(shuffled)));
}

TEST(Bvh, TakesMeshesWithoutTrianglesAndTrianglesWithoutArea)
{
    const std::vector<BvhNode> none = bvhOf({}, {});
    ASSERT_EQ(none.size(), 2u);
    EXPECT_EQ(none[1].triangleCount, 0u);
    EXPECT_GT(none[1].lowest.x, none[1].highest.x);

    const std::vector<vec3> points{{1, 2, 3}, {4, 5, 6}};
    const std::vector<uint32_t> indices{0, 0, 0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 0, 0, 1};
    const std::vector<BvhNode> flat = bvhOf(points, indices);
    ASSERT_EQ(flat.size(), 4u);
    EXPECT_EQ(flat[1].lowest, points[0]);
    EXPECT_EQ(flat[1].highest, points[1]);
    EXPECT_EQ(flat[2].triangleCount + flat[3].triangleCount, 5u);
}

} // namespace
} // namespace antumbra::render
