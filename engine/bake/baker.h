// Bakes a scene: deals texels and cells out over threads and processes, keeps what is done, and goes on from it. What comes out depends
// on the scene and the settings alone, to the byte.
#pragma once

#include "bake/bake.h"
#include "bake/peers.h"
#include "bake/static_scene.h"
#include "base/file.h"

#include <functional>
#include <optional>

namespace antumbra::bake {

/// What the baker will take, before it starts; beside what the program holds already.
struct BakeEstimate
{
    uint64_t bytes = 0; // at most, at a time
    uint64_t rays = 0;
};
BakeEstimate estimate(const StaticScene& scene, const BakeSettings& settings);
/// About the greatest density, at most the settings', at which the bake stays within `mostBytes`; nothing where none does.
std::optional<float> densityWithin(const StaticScene& scene, const BakeSettings& settings, uint64_t mostBytes);

struct BakeProgress
{
    std::string_view stage; // "direct light", "bounce 1" ..., "volume"
    uint64_t raysDone = 0;
    uint64_t raysAll = 0;
    double raysPerSecond = 0; // of all processes, since the start; 0 where nothing is known yet
    double secondsLeft = 0;
};

struct BakeJob
{
    uint32_t threads = 0;   // of each process; 0: as many as the machine has
    Peers peers;            // all of them bake the same scene with the same settings
    Path partial;           // where the first process keeps what is done, also of a whole bake; nowhere where empty
    bool isResumed = false; // goes on from `partial`, which must be of this scene and these settings
    std::function<void(const BakeProgress&)> report; // by the first process, from the calling thread, a few times a second
    std::function<bool()> isInterrupted;             // asked between tiles, from the calling thread
};

/// The same for every process. Nothing when any of them is interrupted: what is done lies in job.partial.
/// Throws Error where `partial` is of something else, damaged, or cannot be written.
std::optional<Bake> bakeScene(const StaticScene& scene, const BakeSettings& settings, const BakeJob& job);

} // namespace antumbra::bake
