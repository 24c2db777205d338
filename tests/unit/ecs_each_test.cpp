#include "ecs/each.h"

#include <gtest/gtest.h>

#include <set>
#include <type_traits>

namespace {

using namespace antumbra::ecs;

struct Position
{
    int x = 0;
};
struct Velocity
{
    int x = 0;
};
struct Hidden
{
};
struct NeverAdded
{
};

static_assert(std::is_same_v<Each<Position, const Velocity>::Row, std::tuple<Position&, const Velocity&>>);
static_assert(
    std::is_same_v<Each<Entity, const Position, With<Hidden>, Maybe<Velocity>>::Row, std::tuple<Entity, const Position&, Velocity*>>);
static_assert(std::is_constructible_v<Each<const Position, Maybe<const Velocity>, Without<Hidden>>, const World&>);
static_assert(!std::is_constructible_v<Each<Position>, const World&>, "what is const cannot be written through");
static_assert(!std::is_constructible_v<Each<const Position, Maybe<Velocity>>, const World&>);

TEST(Each, WritesThroughItsReferences)
{
    World world;
    const Entity moving = world.create(Position{1}, Velocity{10});
    const Entity still = world.create(Position{5});
    for (auto [position, velocity] : Each<Position, const Velocity>(world))
        position.x += velocity.x;
    EXPECT_EQ(world.get<Position>(moving).x, 11);
    EXPECT_EQ(world.get<Position>(still).x, 5);
}

TEST(Each, YieldsTheEntityWithItsGeneration)
{
    World world;
    world.destroy(world.create(Position{0}));
    const Entity second = world.create(Position{2});
    size_t count = 0;
    for (auto [entity, position] : Each<Entity, const Position>(world)) {
        EXPECT_EQ(entity, second);
        ++count;
    }
    EXPECT_EQ(count, 1u);
}

TEST(Each, LeavesOutWhatWithoutRefuses)
{
    World world;
    world.create(Position{1});
    world.create(Position{2}, Hidden{});
    std::set<int> seen;
    for (auto [position] : Each<const Position, Without<Hidden>>(world))
        seen.insert(position.x);
    EXPECT_EQ(seen, std::set<int>{1});
    for (auto [position] : Each<const Position, With<Hidden>>(world))
        seen.insert(position.x);
    EXPECT_EQ(seen, (std::set<int>{1, 2}));
}

TEST(Each, MaybeIsNullWhereThereIsNone)
{
    World world;
    world.create(Position{1}, Velocity{3});
    world.create(Position{2});
    for (auto [position, velocity] : Each<const Position, Maybe<const Velocity>>(world)) {
        ASSERT_EQ(velocity != nullptr, position.x == 1);
        if (velocity != nullptr) {
            EXPECT_EQ(velocity->x, 3);
        }
    }
}

TEST(Each, AComponentThatNobodyHasMatchesNothing)
{
    World world;
    world.create(Position{1});
    const auto count = [](const auto& each) { return std::ranges::distance(each.begin(), each.end()); };
    EXPECT_EQ(count(Each<const NeverAdded>(world)), 0);
    EXPECT_EQ(count(Each<const Position, const NeverAdded>(world)), 0);
    EXPECT_EQ(count(Each<const Position, Maybe<const NeverAdded>, Without<NeverAdded>>(world)), 1);
}

TEST(Each, FindsOneEntityAndNoStaleOne)
{
    World world;
    const Entity moving = world.create(Position{1}, Velocity{10});
    const Entity still = world.create(Position{5});
    const Entity gone = world.create(Position{6}, Velocity{6});
    world.destroy(gone);
    world.create(Position{7}, Velocity{7}); // takes the slot of `gone`

    const Each<Position, const Velocity> each(world);
    EXPECT_FALSE(each.find(still));
    EXPECT_FALSE(each.find(gone));
    auto found = each.find(moving);
    ASSERT_TRUE(found);
    std::get<0>(*found).x = 42;
    EXPECT_EQ(world.get<Position>(moving).x, 42);
}

TEST(Each, VisitsInOrderOfCreationWhileNothingWasRemoved)
{
    World world;
    for (int i = 0; i < 100; ++i)
        world.create(Position{i});
    int expected = 0;
    for (auto [position] : Each<const Position>(world))
        EXPECT_EQ(position.x, expected++);
    EXPECT_EQ(expected, 100);
}

TEST(Each, BareEntitiesMayBeCreatedDuringALoop)
{
    World world;
    std::vector<Entity> expected;
    for (int i = 0; i < 3; ++i)
        expected.push_back(world.create(Position{i}));
    std::vector<Entity> seen;
    for (auto [entity, position] : Each<Entity, const Position>(world)) {
        for (int i = 0; i < 1000; ++i)
            (void)world.create();
        seen.push_back(entity);
    }
    EXPECT_EQ(seen, expected);
}

} // namespace
