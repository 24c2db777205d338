#include "app/baking.h"

#include "app/bake_progress.h"
#include "app/process_memory.h"
#include "app/surfaces.h"
#include "bake/bake_file.h"
#include "bake/baker.h"
#include "base/error.h"
#include "base/log.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace antumbra::app {

namespace {

using Clock = std::chrono::steady_clock;

double mebibytes(uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

void checkMemory(const BakeRequest& request, const bake::StaticScene& surfaces, uint64_t loadedBytes, uint64_t bakeBytes)
{
    const uint64_t bytes = loadedBytes + bakeBytes;
    if (!request.mostBytes || bytes <= *request.mostBytes)
        return;
    const uint64_t left = *request.mostBytes - std::min(*request.mostBytes, loadedBytes);
    const std::optional<float> density = bake::densityWithin(surfaces, request.settings, left);
    const std::string advice =
        density ? fmt::format("--set prt.density={:.3g} would fit", std::floor(100 * *density) / 100) : "no density of texels would fit";
    throw Error(
        fmt::format("takes about {:.0f} MiB, more than the limit of {:.0f}; {}", mebibytes(bytes), mebibytes(*request.mostBytes), advice),
        request.scene.file.string());
}

} // namespace

Path partialOf(const Path& output) { return output.string() + ".partial"; }

bool bakeToFile(const BakeRequest& request, const InterruptGuard& interrupt)
{
    const Clock::time_point started = Clock::now();
    const Surfaces surfaces(request.scene, request.settings);
    const uint64_t loadedBytes = residentBytes();
    const bake::BakeEstimate estimate = bake::estimate(surfaces.scene, request.settings);
    checkMemory(request, surfaces.scene, loadedBytes, estimate.bytes);

    bake::BakeJob job{.threads = request.threads,
                      .peers = request.peers,
                      .partial = partialOf(request.output),
                      .isResumed = request.isResumed,
                      .isInterrupted = [&interrupt] { return interrupt.isInterrupted(); }};
    std::optional<bake::Bake> bake;
    {
        ProgressBar bar;
        job.report = [&bar](const bake::BakeProgress& progress) { bar.show(progress); };
        bake = bakeScene(surfaces.scene, request.settings, job);
    }
    const bool isFirst = request.peers.rank == 0;
    if (!bake && isFirst)
        logWarning("interrupted: what is done is kept in {}; --resume goes on from it", job.partial.string());
    if (!bake || !isFirst)
        return bake.has_value();
    saveBake(request.output, *bake);
    std::filesystem::remove(job.partial);
    const uvec3 cells = bake->volume.grid.count;
    fmt::print("{}: {} x {} texels, {} x {} x {} cells, {:.1f} MiB; {:.1f} s, {:.0f} MiB of memory at the peak, {:.0f} MiB estimated\n",
               request.output.string(), bake->atlas.extent.x, bake->atlas.extent.y, cells.x, cells.y, cells.z,
               mebibytes(std::filesystem::file_size(request.output)), std::chrono::duration<double>(Clock::now() - started).count(),
               mebibytes(peakBytes()), mebibytes(loadedBytes + estimate.bytes));
    return true;
}

} // namespace antumbra::app
