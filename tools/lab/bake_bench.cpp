#include "tools/lab/bake_bench.h"

#include "app/baked_light.h"
#include "app/stage.h"
#include "bake/bake_error.h"
#include "bake/settings.h"
#include "bake/texel_rays.h"
#include "tools/lab/embree_alone.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/gtx/rotate_vector.hpp>
#include <thread>

namespace antumbra::lab {

namespace {

using Clock = std::chrono::steady_clock;
using bake::Range;

constexpr uint32_t kPoints = 1500; // of the surface
constexpr uint32_t kTurns = 5;
constexpr uint32_t kPlaces = 16;          // spread over the page, and over the grid
constexpr uint32_t kTexelsPerPlace = 128; // about as many as the baker deals out at a time
constexpr uint32_t kCellsPerPlace = 16;
constexpr size_t kPacketsAtATime = 256; // stay in a cache

double millisecondsOf(const std::function<void()>& work)
{
    const Clock::time_point start = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Transfers such that bounces have something to read everywhere.
bake::Transfers allLit(const bake::TexelMap& map, const bake::BakeSettings& settings)
{
    bake::Transfers lit = noTransfers(map, settings);
    std::ranges::fill(lit.values, vec3(0.1f));
    std::ranges::fill(lit.isValid, uint8_t{1});
    return lit;
}

/// `places` ranges of at most `count`, spread over `all`.
std::vector<Range> spread(uint32_t all, uint32_t places, uint32_t count)
{
    std::vector<Range> ranges;
    for (uint32_t place = 0; place < places; ++place) {
        const auto first = static_cast<uint32_t>(uint64_t{all} * place / places);
        ranges.push_back({first, std::min(count, all - first)});
    }
    return ranges;
}

/// What a part of the bake takes, with the baker and without.
struct Paired
{
    double bakerMilliseconds = 0;
    double aloneMilliseconds = 0;

    [[nodiscard]] double share() const { return aloneMilliseconds / bakerMilliseconds; }
};

} // namespace

BakeBench::BakeBench(const app::SweepPoint& point) : BakeBench(point, app::findScene(point.scene, point.settings)) {}

BakeBench::BakeBench(const app::SweepPoint& point, const scene::SceneFile& scene)
    : point_(point), knobs_(resolveKnobs(render::DeviceClass::Cpu, scene.settings, point.settings)),
      environmentRadians_(scene.environment ? scene.environment->rotationRadians : 0), surfaces_(scene, knobs_.prt.settings)
{
}

render::Settings BakeBench::knobsOf(const app::SweepPoint& point)
{
    const render::Knobs knobs =
        resolveKnobs(render::DeviceClass::Cpu, app::findScene(point.scene, point.settings).settings, point.settings);
    return render::valuesOf(knobs);
}

std::optional<Samples> BakeBench::measure(const app::InterruptGuard& interrupt)
{
    const bake::BakeSettings& settings = knobs_.prt.settings;
    const uint32_t threads = std::max(std::thread::hardware_concurrency(), 1u);
    const bake::BakeJob job{.threads = threads, .isInterrupted = [&] { return interrupt.isInterrupted(); }};
    Samples samples;
    push(samples.times, "bake", millisecondsOf([&] { bake_ = bakeScene(surfaces_.scene, settings, job); }));
    if (!bake_)
        return std::nullopt;
    push(samples.counters, "threads", threads);
    push(samples.counters, "triangles", surfaces_.scene.triangleCount());
    push(samples.counters, "cells", bake_->volume.grid.cellCount());
    push(samples.counters, "estimated_bytes", static_cast<double>(estimate(surfaces_.scene, settings).bytes));
    measureShare(samples);
    return samples;
}

void BakeBench::measureShare(Samples& samples) const
{
    const bake::BakeSettings& settings = knobs_.prt.settings;
    const bake::TexelMap map = bake::mapTexels(surfaces_.scene, bake::kPointsPerTexel);
    const bake::RayScene rays(surfaces_.scene);
    EmbreeAlone alone(surfaces_.scene);
    const bake::Transfers lit = allLit(map, settings);
    bake::Transfers gathered = lit;

    bake::TexelRays texelRays(surfaces_.scene, map, settings.raysPerTexel);
    const auto traceTexels = [&](Range range) {
        double milliseconds = 0;
        for (uint32_t texel = range.first; texel < range.first + range.count; ++texel)
            for (uint32_t point = 0; point < texelRays.pointCount(texel); ++point)
                texelRays.forEach(texel, point, [&](vec3 origin, const bake::DirectionPacket& directions, bake::LaneMask above) {
                    alone.add(origin, directions, above);
                    milliseconds += alone.traceAfter(kPacketsAtATime);
                });
        return milliseconds + alone.trace();
    };
    Paired direct, bounce;
    for (const Range range : spread(map.texelCount(), kPlaces, kTexelsPerPlace)) {
        direct.bakerMilliseconds += millisecondsOf([&] { gatherDirect(rays, map, settings, range, gathered); });
        direct.aloneMilliseconds += traceTexels(range);
        bounce.bakerMilliseconds += millisecondsOf([&] { gatherBounce(rays, map, settings, lit, range, gathered); });
        bounce.aloneMilliseconds += traceTexels(range);
    }

    const bake::Grid& grid = bake_->volume.grid;
    bake::CellLight light = noCellLight(grid, settings);
    const std::vector<bake::DirectionPacket> sphere = bake::sphereDirections((settings.raysPerCell + bake::kLanes - 1) / bake::kLanes);
    Paired volume;
    for (const Range range : spread(grid.cellCount(), kPlaces, kCellsPerPlace)) {
        volume.bakerMilliseconds += millisecondsOf([&] { gatherCells(rays, map, settings, lit, grid, range, light); });
        for (uint32_t cell = range.first; cell < range.first + range.count; ++cell)
            for (const bake::DirectionPacket& local : sphere) {
                bake::DirectionPacket directions;
                rotate(bake::rotationOf(bake::scrambled(cell)), local, directions);
                alone.add(grid.position(cell), directions, bake::kAllLanes);
                volume.aloneMilliseconds += alone.traceAfter(kPacketsAtATime);
            }
        volume.aloneMilliseconds += alone.trace();
    }

    push(samples.times, "direct light, some texels", direct.bakerMilliseconds);
    push(samples.times, "bounce, some texels", bounce.bakerMilliseconds);
    push(samples.times, "volume, some cells", volume.bakerMilliseconds);
    push(samples.counters, "texels", map.texelCount());
    const auto rayCount = static_cast<double>(bake::rayCount(settings, map.texelCount(), grid.cellCount()));
    push(samples.counters, "rays", rayCount);
    push(samples.counters, "rays_per_second", rayCount / (1e-3 * samples.times.front().values.front()));
    push(samples.counters, "kept_direct", direct.share());
    push(samples.counters, "kept_bounce", bounce.share());
    push(samples.counters, "kept_volume", volume.share());
    // All of the bake, by how much of each there is in it.
    const double passes = static_cast<double>(map.texelCount()) / (kPlaces * kTexelsPerPlace);
    const double cells = static_cast<double>(grid.cellCount()) / (kPlaces * kCellsPerPlace);
    const auto all = [&](double Paired::*time) {
        return passes * (direct.*time + settings.bounces * (bounce.*time)) + cells * (volume.*time);
    };
    push(samples.counters, "embree_rays_per_second", rayCount / (1e-3 * all(&Paired::aloneMilliseconds))); // of one thread
    push(samples.counters, "kept", all(&Paired::aloneMilliseconds) / all(&Paired::bakerMilliseconds));
}

app::ImageError BakeBench::error() const
{
    const bake::RayScene rays(surfaces_.scene);
    const scene::ImageF& map = surfaces_.assets.environments.front();
    const bake::ShFunction light = bake::project(map, knobs_.prt.settings.bands);
    const std::vector<bake::SurfacePoint> points = bake::seenPoints(rays, kPoints, 1);
    bake::ErrorAgainstTruth error;
    for (uint32_t turn = 0; turn < kTurns; ++turn) {
        const double radians = environmentRadians_ + 2 * std::numbers::pi * turn / kTurns;
        const bake::ShFunction turned = rotatedAboutY(light, radians);
        bake::Radiance truth = turned;
        if (point_.truth == app::BakeTruth::Map)
            truth = [&, radians](const glm::dvec3& direction) { return bake::texelTowards(map, glm::rotateY(direction, -radians)); };
        error.add(errorOf(*bake_, rays, windowed(turned, knobs_.prt.window), truth, points, point_.referenceSamples));
    }
    const double none = std::nan("");
    return {.rmse = error.rmse(), .relativeRmse = error.relative(), .mae = none, .ssim = none, .percentile99 = none};
}

} // namespace antumbra::lab
