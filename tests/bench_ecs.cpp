// What the ECS costs (DESIGN.md, Map: engine/ecs). Figures to compare with: EnTT publishes 40.7 ms for createPairs and 1038 ns for
// sevenSystems, on another machine. Run with --benchmark_repetitions=9 and read the median.
#include "ecs/schedule.h"

#include <benchmark/benchmark.h>

namespace {

using namespace antumbra::ecs;

constexpr uint32_t kMillion = 1'000'000;

struct Position
{
    float x = 0, y = 0, z = 0;
};
struct Velocity
{
    float x = 1, y = 1, z = 1;
};
struct Mass
{
    float kilograms = 1;
};
struct Health
{
    int32_t points = 100, greatest = 200;
    bool isAlive = true;
};
struct Damage
{
    int32_t attack = 12, defence = 6;
};
struct Sprite
{
    uint32_t glyph = ' ';
};
struct Counter
{
    uint32_t steps = 0;
    uint32_t noise = 1;
};

/// A million entities of which every `stride`-th has Velocity and Mass.
World crowded(uint32_t stride)
{
    World world;
    for (uint32_t i = 0; i < kMillion; ++i) {
        const Entity entity = world.create(Position{});
        if (i % stride == 0) {
            world.add(entity, Velocity{});
            world.add(entity, Mass{});
        }
    }
    return world;
}

void createPairs(benchmark::State& state)
{
    for (auto _ : state) {
        World world;
        for (uint32_t i = 0; i < kMillion; ++i)
            world.create(Position{}, Velocity{});
        benchmark::DoNotOptimize(world.entityCount());
        state.PauseTiming();
        world = World();
        state.ResumeTiming();
    }
}

void iterateOne(benchmark::State& state)
{
    World world = crowded(static_cast<uint32_t>(state.range(0)));
    for (auto _ : state) {
        for (auto [velocity] : Each<Velocity>(world))
            velocity.x += 1.0f;
        benchmark::ClobberMemory();
    }
}

void iterateTwo(benchmark::State& state)
{
    World world = crowded(static_cast<uint32_t>(state.range(0)));
    for (auto _ : state) {
        for (auto [position, velocity] : Each<Position, const Velocity>(world))
            position.x += velocity.x;
        benchmark::ClobberMemory();
    }
}

void iterateThree(benchmark::State& state)
{
    World world = crowded(static_cast<uint32_t>(state.range(0)));
    for (auto _ : state) {
        for (auto [position, velocity, mass] : Each<Position, const Velocity, const Mass>(world))
            position.x += velocity.x * mass.kilograms;
        benchmark::ClobberMemory();
    }
}

void addAndRemove(benchmark::State& state)
{
    World world;
    std::vector<Entity> entities;
    for (uint32_t i = 0; i < kMillion; ++i)
        entities.push_back(world.create(Position{}));
    for (auto _ : state) {
        for (const Entity entity : entities)
            world.add(entity, Velocity{});
        for (const Entity entity : entities)
            world.remove<Velocity>(entity);
    }
}

void destroyAndCreate(benchmark::State& state)
{
    World world;
    std::vector<Entity> entities;
    for (uint32_t i = 0; i < kMillion; ++i)
        entities.push_back(world.create(Position{}, Velocity{}));
    for (auto _ : state) {
        for (Entity& entity : entities)
            world.destroy(entity);
        for (Entity& entity : entities)
            entity = world.create(Position{}, Velocity{});
    }
}

void move(Each<Position, const Velocity> moving, Seconds step)
{
    for (auto [position, velocity] : moving) {
        position.x += velocity.x * step.value;
        position.y += velocity.y * step.value;
    }
}

void count(Each<Counter> counters)
{
    for (auto [counter] : counters) {
        ++counter.steps;
        counter.noise = counter.noise * 1664525u + 1013904223u;
    }
}

void wander(Each<const Position, Velocity, const Counter> wandering)
{
    for (auto [position, velocity, counter] : wandering) {
        if (counter.steps % 10 != 0)
            continue;
        const float turn = counter.noise > 0x80000000u ? 1.0f : -1.0f;
        velocity.x = position.x > 100.0f ? -1.0f : turn;
        velocity.y = position.y > 100.0f ? -1.0f : turn;
    }
}

void heal(Each<Health> living)
{
    for (auto [health] : living) {
        if (health.points <= 0 && health.isAlive)
            health.isAlive = false;
        else if (health.isAlive && health.points < health.greatest)
            ++health.points;
    }
}

void strike(Each<Health, const Damage> struck)
{
    for (auto [health, damage] : struck)
        health.points -= std::max(0, damage.attack - damage.defence) * static_cast<int32_t>(health.isAlive);
}

void choose(Each<Sprite, const Health> shown)
{
    for (auto [sprite, health] : shown)
        sprite.glyph = !health.isAlive ? U'|' : health.points < health.greatest / 2 ? U'?' : U'_';
}

struct Screen
{
    std::array<uint32_t, 100 * 100> glyphs{};
};

void draw(Each<const Position, const Sprite> shown, Screen& screen)
{
    for (auto [position, sprite] : shown) {
        const auto column = static_cast<uint32_t>(std::clamp(position.x, 0.0f, 99.0f));
        const auto row = static_cast<uint32_t>(std::clamp(position.y, 0.0f, 99.0f));
        screen.glyphs[row * 100 + column] = sprite.glyph;
    }
}

/// Seven small systems over 64 entities: all have Position, Velocity and Counter, every second one Health, Damage and Sprite.
void sevenSystems(benchmark::State& state)
{
    World world;
    world.setResource(Seconds{1.0f / 60.0f});
    world.setResource(Screen{});
    for (uint32_t i = 0; i < 64; ++i) {
        const Entity entity = world.create(Position{}, Velocity{}, Counter{0, i});
        if (i % 2 == 0) {
            world.add(entity, Health{});
            world.add(entity, Damage{});
            world.add(entity, Sprite{});
        }
    }
    Schedule schedule;
    schedule.add("move", move);
    schedule.add("count", count);
    schedule.add("wander", wander).after("move").after("count");
    schedule.add("heal", heal);
    schedule.add("strike", strike).after("heal");
    schedule.add("choose", choose).after("strike");
    schedule.add("draw", draw).after("choose").after("move");
    schedule.compile();
    for (auto _ : state)
        schedule.run(world);
}

BENCHMARK(createPairs)->Unit(benchmark::kMillisecond);
BENCHMARK(iterateOne)->Arg(1)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(iterateTwo)->Arg(1)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(iterateThree)->Arg(1)->Arg(8)->Unit(benchmark::kMicrosecond);
BENCHMARK(addAndRemove)->Unit(benchmark::kMillisecond);
BENCHMARK(destroyAndCreate)->Unit(benchmark::kMillisecond);
BENCHMARK(sevenSystems)->Unit(benchmark::kNanosecond);

} // namespace

BENCHMARK_MAIN();
