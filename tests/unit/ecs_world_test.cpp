#include "ecs/world.h"

#include "ecs/each.h"

#include <gtest/gtest.h>

namespace {

using namespace antumbra::ecs;

struct Position
{
    int x = 0;
};
struct Label
{
    std::string text;
};

TEST(World, AnEntityThatWasDestroyedStaysDead)
{
    World world;
    const Entity first = world.create(Position{1});
    EXPECT_TRUE(world.isAlive(first));
    EXPECT_TRUE(world.destroy(first));
    EXPECT_FALSE(world.isAlive(first));
    EXPECT_FALSE(world.destroy(first));

    const Entity second = world.create(Position{2});
    EXPECT_EQ(second.index, first.index);
    EXPECT_FALSE(world.isAlive(first));
    EXPECT_EQ(world.find<Position>(first), nullptr);
    EXPECT_FALSE(world.remove<Position>(first));
    EXPECT_EQ(world.get<Position>(second).x, 2);
}

TEST(World, TheNullEntityIsNeverAlive)
{
    World world;
    EXPECT_FALSE(world.isAlive(Entity{}));
    (void)world.create();
    EXPECT_FALSE(world.isAlive(Entity{}));
    EXPECT_FALSE(world.isAlive(Entity{0, 2}));
    EXPECT_FALSE(world.isAlive(Entity{7, 1}));
}

TEST(World, DestroyingTakesAllComponents)
{
    World world;
    const Entity entity = world.create(Position{1}, Label{"one"});
    world.destroy(entity);
    const Entity reused = world.create();
    EXPECT_FALSE(world.has<Position>(reused));
    EXPECT_FALSE(world.has<Label>(reused));
    EXPECT_EQ(world.entityCount(), 1u);
}

TEST(World, AddReplacesAndRemoveReportsWhetherThereWasOne)
{
    World world;
    const Entity entity = world.create();
    EXPECT_FALSE(world.remove<Label>(entity));
    world.add(entity, Label{"a"});
    world.add(entity, Label{"b"});
    EXPECT_EQ(world.get<Label>(entity).text, "b");
    EXPECT_TRUE(world.remove<Label>(entity));
    EXPECT_FALSE(world.remove<Label>(entity));
}

TEST(World, RemovingFromTheMiddleKeepsEveryOtherValueWithItsEntity)
{
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 10'000; ++i) // more than one page of the sparse index
        entities.push_back(world.create(Label{std::to_string(i)}));
    for (int i = 0; i < 10'000; i += 3)
        world.remove<Label>(entities[static_cast<size_t>(i)]);
    for (int i = 0; i < 10'000; ++i) {
        const Label* label = world.find<Label>(entities[static_cast<size_t>(i)]);
        ASSERT_EQ(label == nullptr, i % 3 == 0) << i;
        if (label != nullptr) {
            ASSERT_EQ(label->text, std::to_string(i));
        }
    }
}

TEST(World, AResourceIsOneValueOfItsType)
{
    World world;
    world.setResource(Label{"first"});
    world.setResource(Label{"second"});
    world.setResource(7);
    world.resource<int>() += 1;
    EXPECT_EQ(std::as_const(world).resource<Label>().text, "second");
    EXPECT_EQ(world.resource<int>(), 8);
}

TEST(WorldDeathTest, MistakesAreRefused)
{
    World world;
    const Entity entity = world.create(Position{1});
    const Entity dead = world.create();
    world.destroy(dead);
    EXPECT_DEATH(world.add(dead, Position{}), "alive");
    EXPECT_DEATH((void)world.get<Label>(entity), "has the component");
    EXPECT_DEATH((void)world.resource<Label>(), "resource that was set");
}

TEST(WorldDeathTest, ComponentsMayNotComeOrGoWhileAnEachLives)
{
    World world;
    const Entity entity = world.create(Position{1});
    {
        const Each<const Position> each(world);
        EXPECT_DEATH(world.add(entity, Label{}), "while an Each lives");
        EXPECT_DEATH(world.remove<Position>(entity), "while an Each lives");
        EXPECT_DEATH(world.destroy(entity), "while an Each lives");
        (void)world.create();
    }
    world.add(entity, Label{"now"});
    EXPECT_TRUE(world.has<Label>(entity));
}

} // namespace
