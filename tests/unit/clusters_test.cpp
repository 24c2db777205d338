// Clusters hold every triangle once, and a view leaves out only what it cannot see.
#include "render/clusters.h"

#include "render/frame_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

namespace antumbra::render {
namespace {

constexpr uvec2 kExtent{160, 90};

/// Triangles anywhere within a metre, of materials 1 and 3.
scene::Mesh scatteredTriangles(uint32_t count)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> anywhere(-1, 1);
    scene::Mesh mesh;
    for (uint32_t i = 0; i < count; ++i) {
        const vec3 corner{anywhere(random), anywhere(random), anywhere(random)};
        for (const vec3 offset : {vec3{0}, vec3{0.01f, 0, 0}, vec3{0, 0.01f, 0}}) {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(corner + offset);
        }
        mesh.triangleMaterials.push_back(i % 3 == 0 ? 3 : 1);
    }
    return mesh;
}

float meanExtent(const std::vector<Cluster>& clusters)
{
    float sum = 0;
    for (const Cluster& cluster : clusters)
        sum += glm::length(cluster.box.extent());
    return sum / static_cast<float>(clusters.size());
}

TEST(Clusters, HoldEveryTriangleOnceWithItsMaterial)
{
    const scene::Mesh mesh = scatteredTriangles(500);
    const ClusteredTriangles made = clustersOf(mesh, mesh.positions, 32);
    std::map<uint32_t, uint32_t> materialOfFirstCorner;
    uint32_t next = 0;
    for (const Cluster& cluster : made.clusters) {
        EXPECT_EQ(cluster.firstIndex, next);
        EXPECT_LE(cluster.indexCount, 3u * 32);
        EXPECT_GT(cluster.indexCount, 0u);
        next += cluster.indexCount;
        for (uint32_t i = cluster.firstIndex; i < next; i += 3) {
            EXPECT_EQ(made.indices[i + 1], made.indices[i] + 1) << "corners in another order";
            EXPECT_EQ(made.indices[i + 2], made.indices[i] + 2) << "corners in another order";
            EXPECT_TRUE(materialOfFirstCorner.emplace(made.indices[i], cluster.material).second) << "a triangle twice";
        }
    }
    EXPECT_EQ(next, mesh.indices.size());
    for (uint32_t triangle = 0; triangle < mesh.triangleMaterials.size(); ++triangle)
        EXPECT_EQ(materialOfFirstCorner.at(3 * triangle), mesh.triangleMaterials[triangle]);
}

TEST(Clusters, AreBoxedInTheRestPoseAndLieCloseTogether)
{
    const scene::Mesh mesh = scatteredTriangles(4096);
    std::vector<vec3> rest = mesh.positions;
    for (vec3& position : rest)
        position += vec3{100, 0, 0};
    const ClusteredTriangles made = clustersOf(mesh, rest, 64);
    for (const Cluster& cluster : made.clusters)
        for (uint32_t i = cluster.firstIndex; i < cluster.firstIndex + cluster.indexCount; ++i) {
            const vec3 position = rest[made.indices[i]];
            EXPECT_TRUE(glm::all(glm::lessThanEqual(cluster.box.lowest, position)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(position, cluster.box.highest)));
        }
    // 64 and more clusters fill a cube of 2 m: a quarter of its edge each.
    EXPECT_LT(meanExtent(made.clusters), 0.4f * std::sqrt(3.0f) * 2.0f);
}

TEST(Clusters, AreNoneOfAnEmptyMesh)
{
    const ClusteredTriangles made = clustersOf({}, {}, 64);
    EXPECT_TRUE(made.clusters.empty());
    EXPECT_TRUE(made.indices.empty());
}

class FarthestSeen : public testing::Test
{
protected:
    CameraView camera_{.eye = {1, 2, 3}, .rotation = glm::angleAxis(0.7f, glm::normalize(vec3{0.2f, 1, 0.1f}))};
    mat4 clipFromWorld_ = clipFromWorld(camera_, kExtent);

    /// At a point given in view space: right, up, ahead.
    [[nodiscard]] Aabb boxAt(vec3 view, float halfEdge) const
    {
        const vec3 centre = camera_.eye + camera_.rotation * vec3{view.x, view.y, -view.z};
        return {centre - halfEdge, centre + halfEdge};
    }
};

TEST_F(FarthestSeen, IsTheDepthOfTheFarthestCorner)
{
    const Aabb box = boxAt({0, 0, 5}, 0.5f);
    float farthest = 0;
    for (const float x : {box.lowest.x, box.highest.x})
        for (const float y : {box.lowest.y, box.highest.y})
            for (const float z : {box.lowest.z, box.highest.z})
                farthest = std::max(farthest, (clipFromWorld_ * vec4{x, y, z, 1}).w);
    EXPECT_NEAR(farthestSeen(box, clipFromWorld_).value(), farthest, 1e-4f);
    EXPECT_GT(farthest, 5.5f);
}

TEST_F(FarthestSeen, IsNothingOutsideTheView)
{
    for (const vec3 outside : {vec3{0, 0, -2}, vec3{9, 0, 5}, vec3{-9, 0, 5}, vec3{0, 9, 5}, vec3{0, -9, 5}})
        EXPECT_FALSE(farthestSeen(boxAt(outside, 0.5f), clipFromWorld_)) << outside.x << ' ' << outside.y << ' ' << outside.z;
}

TEST_F(FarthestSeen, LeavesOutNoPointThatIsSeen)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-6, 6), share(0, 1), edge(0.01f, 4);
    int seen = 0;
    for (int i = 0; i < 20000; ++i) {
        const Aabb box = boxAt({anywhere(random), anywhere(random), anywhere(random)}, edge(random));
        const vec3 within = box.lowest + box.extent() * vec3{share(random), share(random), share(random)};
        const vec4 clip = clipFromWorld_ * vec4{within, 1};
        if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w || clip.z > clip.w)
            continue;
        ++seen;
        const std::optional<float> farthest = farthestSeen(box, clipFromWorld_);
        ASSERT_TRUE(farthest);
        ASSERT_GE(*farthest, clip.w - 1e-4f);
    }
    EXPECT_GT(seen, 500);
}

TEST_F(FarthestSeen, TakesAPlaceOfItsOwn)
{
    const mat4 worldFromLocal = glm::translate(mat4{1}, camera_.eye + camera_.rotation * vec3{0, 0, -5});
    const Aabb box{vec3{-0.5f}, vec3{0.5f}};
    EXPECT_TRUE(farthestSeen(box, clipFromWorld_ * worldFromLocal));
    EXPECT_FALSE(farthestSeen(box, clipFromWorld_ * glm::translate(mat4{1}, camera_.eye + camera_.rotation * vec3{0, 0, 5})));
}

} // namespace
} // namespace antumbra::render
