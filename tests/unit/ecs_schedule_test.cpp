#include "ecs/schedule.h"

#include "base/error.h"
#include "tests/unit/allocation_counter.h"

#include <gtest/gtest.h>

namespace {

using namespace antumbra::ecs;

struct Spin
{
    float radiansPerSecond = 0;
};
struct Angle
{
    float radians = 0;
};
struct Doomed
{
};
struct Log
{
    std::vector<std::string> lines;
};

void spin(Each<Angle, const Spin> spinning, Seconds step)
{
    for (auto [angle, spin] : spinning)
        angle.radians += spin.radiansPerSecond * step.value;
}
void readAngles(Each<const Angle>) {}
void readSpins(Each<const Spin>) {}
void lookAtMarks(Each<const Doomed, Without<Spin>, With<Angle>>) {}
void mayWriteSpins(Each<const Doomed, Maybe<Spin>>) {}
void writeLog(Log& log) { log.lines.push_back("write"); }
void readLog(const Log&) {}

std::string faultOf(Schedule& schedule)
{
    try {
        schedule.compile();
    } catch (const antumbra::Error& error) {
        return error.what();
    }
    return "";
}

TEST(Schedule, RunsFunctionsWithResourcesByValue)
{
    World world;
    world.setResource(Seconds{0.5f});
    const Entity entity = world.create(Angle{1}, Spin{2});
    Schedule schedule;
    schedule.add("spin", &spin);
    schedule.compile();
    schedule.run(world);
    EXPECT_FLOAT_EQ(world.get<Angle>(entity).radians, 2.0f);
}

TEST(Schedule, RefusesTwoSystemsThatShareWhatOneWrites)
{
    Schedule schedule;
    schedule.add("spin", spin);
    schedule.add("look", readAngles);
    const std::string fault = faultOf(schedule);
    EXPECT_NE(fault.find("spin and look share"), std::string::npos) << fault;
    EXPECT_NE(fault.find("Angle"), std::string::npos) << fault;
}

TEST(Schedule, RefusesConflictsOverResourcesAndOptionalComponents)
{
    Schedule resources;
    resources.add("write", writeLog);
    resources.add("read", readLog);
    EXPECT_NE(faultOf(resources), "");

    Schedule optional;
    optional.add("may write", mayWriteSpins);
    optional.add("read", readSpins);
    EXPECT_NE(faultOf(optional), "");
}

TEST(Schedule, AcceptsReadersPresenceAndDisjointWriters)
{
    Schedule schedule;
    schedule.add("spin", spin);
    schedule.add("read spins", readSpins);
    schedule.add("marks", lookAtMarks);
    schedule.add("log", writeLog);
    EXPECT_EQ(faultOf(schedule), "");
}

TEST(Schedule, AcceptsAnOrderThroughOthers)
{
    Schedule schedule;
    schedule.add("last", readAngles).after("middle");
    schedule.add("middle", readLog).after("spin");
    schedule.add("spin", spin);
    EXPECT_EQ(faultOf(schedule), "");
    EXPECT_EQ(schedule.names(), (std::vector<std::string_view>{"spin", "middle", "last"}));
}

TEST(Schedule, KeepsTheOrderOfAddingWhereItIsFreeTo)
{
    Schedule schedule;
    schedule.add("c", readAngles);
    schedule.add("a", readSpins);
    schedule.add("b", readLog);
    schedule.compile();
    EXPECT_EQ(schedule.names(), (std::vector<std::string_view>{"c", "a", "b"}));
}

TEST(Schedule, RefusesUnknownNamesAndCircles)
{
    Schedule unknown;
    unknown.add("spin", spin).after("input");
    EXPECT_NE(faultOf(unknown).find("input"), std::string::npos);

    Schedule circle;
    circle.add("a", readSpins).after("b");
    circle.add("b", readSpins).after("a");
    EXPECT_NE(faultOf(circle).find("after itself"), std::string::npos);
}

TEST(ScheduleDeathTest, DoesNotRunBeforeItIsCompiled)
{
    World world;
    Schedule schedule;
    schedule.add("spin", spin);
    EXPECT_DEATH(schedule.run(world), "compiled");
    EXPECT_DEATH(schedule.add("spin", spin), "not taken");
}

TEST(Schedule, ChangesWaitUntilAllSystemsHaveRun)
{
    World world;
    world.create(Angle{1}, Doomed{});
    size_t seenAfterwards = 0;
    Schedule schedule;
    schedule.add("replace", [](Each<Entity, const Angle, With<Doomed>> doomed, Commands commands) {
        for (auto [entity, angle] : doomed) {
            commands.destroy(entity);
            commands.add(entity, Spin{1}); // meant for the dead: dropped
            const Entity heir = commands.create(Angle{angle.radians + 1}, Doomed{});
            commands.add(heir, Spin{5});
            commands.remove<Doomed>(heir);
        }
    });
    schedule.add("count", [&](Each<const Angle, With<Doomed>> doomed) {
        seenAfterwards = static_cast<size_t>(std::ranges::distance(doomed.begin(), doomed.end()));
    });
    schedule.compile();
    schedule.run(world);

    EXPECT_EQ(seenAfterwards, 1u);
    EXPECT_EQ(world.entityCount(), 1u);
    for (auto [angle, spin] : Each<const Angle, const Spin, Without<Doomed>>(world)) {
        EXPECT_EQ(angle.radians, 2.0f);
        EXPECT_EQ(spin.radiansPerSecond, 5.0f);
    }
    schedule.run(world);
    EXPECT_EQ(seenAfterwards, 0u);
}

TEST(Schedule, AllocatesNothingInASteadyFrame)
{
    World world;
    world.setResource(Seconds{0.1f});
    for (int i = 0; i < 100; ++i)
        world.create(Angle{0}, Spin{1});
    Schedule schedule;
    schedule.add("spin", spin);
    schedule
        .add("renew",
             [](Each<Entity, const Angle, const Spin> spinning, Commands commands) {
                 for (auto [entity, angle, spin] : spinning) {
                     commands.destroy(entity);
                     commands.create(Angle{angle.radians}, Spin{spin.radiansPerSecond});
                 }
             })
        .after("spin");
    schedule.compile();
    for (int warmUp = 0; warmUp < 3; ++warmUp)
        schedule.run(world);

    const uint64_t before = antumbra::test::allocationCount();
    for (int frame = 0; frame < 300; ++frame)
        schedule.run(world);
    EXPECT_EQ(antumbra::test::allocationCount() - before, 0u);
    EXPECT_EQ(world.entityCount(), 100u);
}

} // namespace
