// The World against a model too simple to be wrong: a map from each entity ever made to what it has.
#include "ecs/each.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using namespace antumbra::ecs;

struct Small
{
    uint32_t value = 0;
};
struct Owning
{
    std::string text;
};
struct Marker
{
};

struct Expected
{
    Entity entity;
    bool isAlive = true;
    std::optional<uint32_t> small;
    std::optional<std::string> owning;
    bool isMarked = false;
};

class WorldAndModel
{
public:
    /// One random operation on a random entity, most often one of the last few hundred, sometimes a long dead one.
    void operate()
    {
        const uint32_t choice = random(16);
        if (model_.empty() || choice < 3)
            return create();
        Expected& expected = any();
        switch (choice) {
        case 3:
        case 4: return destroy(expected);
        case 5:
        case 6:
        case 7: return addSmall(expected);
        case 8:
        case 9: return addOwning(expected);
        case 10: return addMarker(expected);
        case 11: return remove(expected, expected.small, &World::remove<Small>);
        case 12: return remove(expected, expected.owning, &World::remove<Owning>);
        case 13: return removeMarker(expected);
        default: return compare(expected);
        }
    }

    void compareAll()
    {
        size_t aliveCount = 0;
        for (const Expected& expected : model_) {
            compare(expected);
            aliveCount += static_cast<size_t>(expected.isAlive);
        }
        EXPECT_EQ(world_.entityCount(), aliveCount);
    }

    void compareLoops()
    {
        const World& world = world_;
        expectSame(Each<Entity, const Small>(world), [](const Expected& e) { return e.small.has_value(); });
        expectSame(Each<Entity, const Small, const Owning>(world), [](const Expected& e) { return e.small && e.owning; });
        expectSame(Each<Entity, const Owning, Without<Small>>(world), [](const Expected& e) { return e.owning && !e.small; });
        expectSame(Each<Entity, With<Marker>, Maybe<const Small>>(world), [](const Expected& e) { return e.isMarked; });
        expectSame(Each<Entity, const Small, const Owning, With<Marker>>(world),
                   [](const Expected& e) { return e.small && e.owning && e.isMarked; });
        for (auto [entity, small, owning] : Each<Entity, const Small, Maybe<const Owning>>(world)) {
            ASSERT_EQ(&small, world.find<Small>(entity));
            ASSERT_EQ(owning, world.find<Owning>(entity));
        }
    }

private:
    uint32_t random(uint32_t below) { return static_cast<uint32_t>(random_() % below); }

    Expected& any()
    {
        const auto count = static_cast<uint32_t>(model_.size());
        const uint32_t reach = random(8) == 0 ? count : std::min(count, 300u);
        return model_[count - 1 - random(reach)];
    }

    void create()
    {
        const auto value = static_cast<uint32_t>(random_());
        if (random(2) == 0)
            model_.push_back({world_.create(), true, {}, {}, false});
        else
            model_.push_back({world_.create(Small{value}, Marker{}), true, value, {}, true});
    }

    void destroy(Expected& expected)
    {
        ASSERT_EQ(world_.destroy(expected.entity), expected.isAlive);
        expected = {expected.entity, false, {}, {}, false};
    }

    void addSmall(Expected& expected)
    {
        if (!expected.isAlive)
            return;
        expected.small = static_cast<uint32_t>(random_());
        world_.add(expected.entity, Small{*expected.small});
    }
    void addOwning(Expected& expected)
    {
        if (!expected.isAlive)
            return;
        expected.owning = "a text that is too long to be stored in place " + std::to_string(random_());
        world_.add(expected.entity, Owning{*expected.owning});
    }
    void addMarker(Expected& expected)
    {
        if (!expected.isAlive)
            return;
        expected.isMarked = true;
        world_.add(expected.entity, Marker{});
    }

    template <class Value>
    void remove(Expected& expected, std::optional<Value>& value, bool (World::*removeFrom)(Entity))
    {
        ASSERT_EQ((world_.*removeFrom)(expected.entity), value.has_value());
        value.reset();
    }
    void removeMarker(Expected& expected)
    {
        ASSERT_EQ(world_.remove<Marker>(expected.entity), expected.isMarked);
        expected.isMarked = false;
    }

    void compare(const Expected& expected) const
    {
        ASSERT_EQ(world_.isAlive(expected.entity), expected.isAlive);
        const Small* small = world_.find<Small>(expected.entity);
        const Owning* owning = world_.find<Owning>(expected.entity);
        ASSERT_EQ(small != nullptr, expected.small.has_value());
        ASSERT_EQ(owning != nullptr, expected.owning.has_value());
        ASSERT_EQ(world_.has<Marker>(expected.entity), expected.isMarked);
        if (small != nullptr) {
            ASSERT_EQ(small->value, *expected.small);
        }
        if (owning != nullptr) {
            ASSERT_EQ(owning->text, *expected.owning);
        }
    }

    template <class Loop, class Matches>
    void expectSame(const Loop& loop, Matches matches) const
    {
        std::vector<uint64_t> seen;
        for (const auto& row : loop)
            seen.push_back(keyOf(std::get<0>(row)));
        std::vector<uint64_t> wanted;
        for (const Expected& expected : model_) {
            if (matches(expected))
                wanted.push_back(keyOf(expected.entity));
        }
        std::ranges::sort(seen);
        std::ranges::sort(wanted);
        ASSERT_EQ(seen, wanted);
    }
    static uint64_t keyOf(Entity entity) { return uint64_t{entity.index} << 32 | entity.generation; }

    World world_;
    std::vector<Expected> model_; // every entity ever made, the dead too
    std::mt19937_64 random_{20240607};
};

TEST(WorldModel, AgreesOverAMillionRandomOperations)
{
    WorldAndModel both;
    for (uint32_t i = 0; i < 1'000'000 && !testing::Test::HasFatalFailure(); ++i) {
        both.operate();
        if (i % 100'000 == 0)
            both.compareLoops();
    }
    both.compareAll();
    both.compareLoops();
}

} // namespace
