#include "scene/hierarchy.h"

#include "tests/unit/allocation_counter.h"

#include <gtest/gtest.h>

namespace {

using namespace antumbra;
using namespace antumbra::scene;
using ecs::Each;
using ecs::Entity;
using ecs::World;

Each<WorldMatrix, const Transform, ecs::Maybe<const Parent>> placed(World& world)
{
    return Each<WorldMatrix, const Transform, ecs::Maybe<const Parent>>(world);
}

Transform at(float x, float y, float z) { return {.position = vec3(x, y, z)}; }

vec3 positionOf(const World& world, Entity entity) { return vec3(world.get<WorldMatrix>(entity).now[3]); }

TEST(Hierarchy, TheLocalMatrixScalesThenTurnsThenMoves)
{
    const Transform transform{vec3(10, 0, 0), glm::angleAxis(kPi / 2, vec3(0, 1, 0)), vec3(2, 3, 4)};
    const vec4 corner = localMatrix(transform) * vec4(1, 1, 1, 1);
    EXPECT_NEAR(corner.x, 10 + 4, 1e-5f); // +Z turns to +X
    EXPECT_NEAR(corner.y, 3, 1e-5f);
    EXPECT_NEAR(corner.z, -2, 1e-5f); // +X turns to -Z
}

TEST(Hierarchy, ChildrenFollowTheirParentsInWhateverOrderTheyWereMade)
{
    World world;
    const Entity grandchild = world.create(at(0, 0, 1), WorldMatrix{});
    const Entity child = world.create(at(0, 0, 1), WorldMatrix{});
    const Entity root = world.create(Transform{vec3(5, 0, 0), glm::angleAxis(kPi / 2, vec3(0, 1, 0)), vec3(2)}, WorldMatrix{});
    world.add(grandchild, Parent{child});
    world.add(child, Parent{root});
    updateWorldMatrices(placed(world));
    EXPECT_NEAR(glm::distance(positionOf(world, child), vec3(7, 0, 0)), 0, 1e-5f);
    EXPECT_NEAR(glm::distance(positionOf(world, grandchild), vec3(9, 0, 0)), 0, 1e-5f);
}

TEST(Hierarchy, RemembersTheFrameBefore)
{
    World world;
    const Entity entity = world.create(at(1, 0, 0), WorldMatrix{});
    updateWorldMatrices(placed(world));
    world.get<Transform>(entity).position.x = 2;
    updateWorldMatrices(placed(world));
    EXPECT_EQ(world.get<WorldMatrix>(entity).before[3].x, 1);
    EXPECT_EQ(world.get<WorldMatrix>(entity).now[3].x, 2);
    updateWorldMatrices(placed(world));
    EXPECT_EQ(world.get<WorldMatrix>(entity).before, world.get<WorldMatrix>(entity).now);
}

TEST(Hierarchy, AParentThatIsGoneCountsAsTheWorld)
{
    World world;
    const Entity parent = world.create(at(5, 0, 0), WorldMatrix{});
    const Entity child = world.create(at(1, 0, 0), WorldMatrix{}, Parent{parent});
    world.destroy(parent);
    world.create(at(9, 0, 0), WorldMatrix{}); // takes the parent's slot
    updateWorldMatrices(placed(world));
    EXPECT_EQ(positionOf(world, child), vec3(1, 0, 0));
}

TEST(HierarchyDeathTest, ACircleOfParentsIsRefused)
{
    World world;
    const Entity a = world.create(Transform{}, WorldMatrix{});
    const Entity b = world.create(Transform{}, WorldMatrix{}, Parent{a});
    world.add(a, Parent{b});
    EXPECT_DEATH(updateWorldMatrices(placed(world)), "chain of parents that ends");
}

TEST(Hierarchy, AllocatesNothing)
{
    World world;
    Entity above = world.create(at(1, 0, 0), WorldMatrix{});
    for (int i = 0; i < 30; ++i)
        above = world.create(at(1, 0, 0), WorldMatrix{}, Parent{above});
    const uint64_t before = test::allocationCount();
    updateWorldMatrices(placed(world));
    EXPECT_EQ(test::allocationCount() - before, 0u);
    EXPECT_EQ(positionOf(world, above).x, 31);
}

} // namespace
