#include "tools/lab/bake_bench.h"

#include "app/baked_light.h"
#include "app/stage.h"
#include "bake/bake_error.h"
#include "bake/settings.h"
#include "tools/lab/bake_share.h"
#include "tools/lab/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/rotate_vector.hpp>
#include <thread>

namespace antumbra::lab {

namespace {

constexpr uint32_t kPoints = 1500; // of the surface
constexpr uint32_t kTurns = 5;

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
    addShare(samples);
    return samples;
}

void BakeBench::addShare(Samples& samples) const
{
    const bake::BakeSettings& settings = knobs_.prt.settings;
    const bake::Grid& grid = bake_->volume.grid;
    const BakeShare share = measureShare(surfaces_.scene, grid, settings);
    push(samples.times, "direct light, some texels", share.direct.bakerMilliseconds);
    push(samples.times, "bounce, some texels", share.bounce.bakerMilliseconds);
    push(samples.times, "volume, some cells", share.volume.bakerMilliseconds);
    const auto rays = static_cast<double>(bake::rayCount(settings, share.texels, grid.cellCount()));
    push(samples.counters, "texels", share.texels);
    push(samples.counters, "rays", rays);
    push(samples.counters, "rays_per_second", rays / (1e-3 * samples.times.front().values.front()));
    push(samples.counters, "embree_rays_per_second", rays / (1e-3 * share.all.aloneMilliseconds)); // of one thread
    push(samples.counters, "kept", share.all.share());
    push(samples.counters, "kept_direct", share.direct.share());
    push(samples.counters, "kept_bounce", share.bounce.share());
    push(samples.counters, "kept_volume", share.volume.share());
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
