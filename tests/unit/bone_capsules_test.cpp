#include "scene/bone_capsules.h"

#include "base/file.h"
#include "scene/gltf.h"
#include "scene/triangle_joints.h"

#include <gtest/gtest.h>

namespace {

using namespace antumbra;
using namespace antumbra::scene;

/// A tube about the capsule's segment with half balls at its ends, in rings of unequal height.
Mesh capsuleMesh(const BoneCapsule& capsule)
{
    constexpr uint32_t kRings = 40, kSides = 24;
    const vec3 along = glm::normalize(capsule.b - capsule.a), across = glm::normalize(glm::cross(along, vec3(0.3f, 0.5f, 0.8f)));
    Mesh mesh;
    for (uint32_t ring = 0; ring <= kRings; ++ring) {
        const float angle = kPi * static_cast<float>(ring) / kRings - kPi / 2;
        const vec3 centre = ring < kRings / 2 ? capsule.a : capsule.b;
        for (uint32_t side = 0; side < kSides; ++side) {
            const vec3 out = glm::angleAxis(2 * kPi * static_cast<float>(side) / kSides, along) * across;
            mesh.positions.push_back(centre + capsule.radius * (std::cos(angle) * out + std::sin(angle) * along));
            mesh.influences.push_back({.joints = {static_cast<uint16_t>(capsule.joint), 0, 0, 0}, .weights = {1, 0, 0, 0}});
        }
    }
    for (uint32_t ring = 0; ring < kRings; ++ring)
        for (uint32_t side = 0; side < kSides; ++side) {
            const uint32_t a = ring * kSides + side, b = ring * kSides + (side + 1) % kSides;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + kSides, b, b + kSides, a + kSides});
        }
    return mesh;
}

float segmentDistance(const BoneCapsule& capsule, vec3 point)
{
    const vec3 along = capsule.b - capsule.a, from = point - capsule.a;
    return glm::length(from - along * glm::clamp(glm::dot(from, along) / glm::dot(along, along), 0.0f, 1.0f));
}

TEST(BoneCapsules, OfACapsuleIsTheCapsule)
{
    for (const BoneCapsule& capsule : {BoneCapsule{1, {1, 2, 3}, {2, 4, 1}, 0.5f}, BoneCapsule{0, {0, 0, 0}, {0.1f, 0, 0}, 0.3f}}) {
        Model model;
        model.mesh = capsuleMesh(capsule);
        model.joints.resize(2);
        const std::vector<BoneCapsule> found = boneCapsules(model);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].joint, capsule.joint);
        EXPECT_NEAR(found[0].radius, capsule.radius, 0.01f * capsule.radius);
        const bool isTurned = glm::distance(found[0].a, capsule.a) > glm::distance(found[0].b, capsule.a);
        EXPECT_LT(glm::distance(isTurned ? found[0].b : found[0].a, capsule.a), 0.03f * capsule.radius);
        EXPECT_LT(glm::distance(isTurned ? found[0].a : found[0].b, capsule.b), 0.03f * capsule.radius);
    }
}

TEST(BoneCapsules, LieAlongTheSkinOfTheWalker)
{
    const Model model = loadGltf(projectPath("assets") / "characters/walker.glb");
    const std::vector<BoneCapsule> capsules = boneCapsules(model);
    const auto vertices = verticesByJoint(model.mesh);
    ASSERT_EQ(capsules.size(), vertices.size());
    double off = 0;
    size_t count = 0;
    for (const BoneCapsule& capsule : capsules) {
        EXPECT_GT(capsule.radius, 0.005f);
        for (const uint32_t vertex : vertices.at(capsule.joint)) {
            off += std::abs(segmentDistance(capsule, model.mesh.positions[vertex]) - capsule.radius);
            ++count;
        }
    }
    EXPECT_LT(off / static_cast<double>(count), 0.015) << "metres";
}

TEST(BoneCapsules, JointsWithoutAnAreaHaveNone)
{
    Model model;
    model.mesh = capsuleMesh({0, {0, 0, 0}, {0, 1, 0}, 0.2f});
    const auto first = static_cast<uint32_t>(model.mesh.positions.size());
    for (int i = 0; i < 3; ++i) {
        model.mesh.positions.emplace_back(5, 0, 0);
        model.mesh.influences.push_back({.joints = {1, 0, 0, 0}, .weights = {1, 0, 0, 0}});
    }
    model.mesh.indices.insert(model.mesh.indices.end(), {first, first + 1, first + 2});
    model.joints.resize(2);
    const std::vector<BoneCapsule> found = boneCapsules(model);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].joint, 0u);
    EXPECT_TRUE(boneCapsules(Model{}).empty());
}

} // namespace
