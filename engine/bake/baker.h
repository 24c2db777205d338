// Bakes a scene: deals texels and cells out over threads and, under MPI, over processes, keeps what is done, and goes on from it. What
// comes out depends on the scene and the settings alone, to the byte.
#pragma once

#include "bake/bake.h"
#include "bake/static_scene.h"
#include "base/file.h"

#include <functional>
#include <optional>

namespace antumbra::bake {

/// What the baker will take at most, before it starts.
struct BakeEstimate
{
    uint64_t bytes = 0;
    uint64_t rays = 0;
};
BakeEstimate estimate(const StaticScene& scene, const BakeSettings& settings);
/// The greatest density at which the bake stays within `mostBytes`; nothing where none does.
std::optional<float> densityWithin(const StaticScene& scene, const BakeSettings& settings, uint64_t mostBytes);

struct BakeProgress
{
    std::string_view stage; // "direct light", "bounce 1" ..., "volume"
    uint64_t raysDone = 0;
    uint64_t raysAll = 0;
    double raysPerSecond = 0;
    double secondsLeft = 0;
};

struct BakeJob
{
    uint32_t threads = 0;                            // 0: as many as the machine has
    Path partial;                                    // what is done is kept here, and removed at the end
    bool isResumed = false;                          // goes on from `partial`, which must be of this scene and these settings
    std::function<void(const BakeProgress&)> report; // now and then, from the calling thread; by one process of all
    std::function<bool()> isInterrupted;             // asked between tiles
};

/// Nothing when interrupted: what is done lies in job.partial. Under MPI (base/bake processes that mpirun started) all processes call it,
/// and the first alone gets the bake. Throws Error where `partial` is not of this scene and these settings.
std::optional<Bake> bakeScene(const StaticScene& scene, const BakeSettings& settings, const BakeJob& job);

} // namespace antumbra::bake
