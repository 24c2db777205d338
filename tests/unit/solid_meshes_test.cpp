#include "scene/solid_meshes.h"

#include "scene/mesh_body.h"

#include <gtest/gtest.h>

#include <numbers>

namespace antumbra::scene {
namespace {

TEST(SolidMeshes, AreClosedAndConvexBodiesAsTheyAreDrawn)
{
    const std::optional<ConvexBody> icosphere = meshBody(makeIcosphere()), frustum = meshBody(makeFrustum());
    ASSERT_TRUE(icosphere && frustum);
    EXPECT_EQ(icosphere->vertices.size(), 42u);
    EXPECT_NEAR(surfaceArea(*icosphere), std::numbers::pi, 1e-5);
    EXPECT_EQ(frustum->vertices.size(), 24u);
    EXPECT_EQ(frustum->faces.size(), 14u);
    const Aabb box = makeFrustum().bounds();
    EXPECT_NEAR(box.highest.y - box.lowest.y, 1, 1e-6);
    EXPECT_NEAR(box.highest.x, 0.5, 1e-6);
}

TEST(SolidMeshes, ADiskHasTheAreaOfItsCircleAndFacesUp)
{
    const Mesh disk = makeDisk();
    double area = 0;
    for (size_t i = 0; i < disk.indices.size(); i += 3) {
        const vec3 a = disk.positions[disk.indices[i]];
        area += 0.5 * glm::length(glm::cross(disk.positions[disk.indices[i + 1]] - a, disk.positions[disk.indices[i + 2]] - a));
    }
    EXPECT_NEAR(area, std::numbers::pi / 4, 1e-5);
    for (const vec3& normal : disk.normals)
        EXPECT_EQ(normal, vec3(0, 1, 0));
}

} // namespace
} // namespace antumbra::scene
