// bake SCENE: the light of a scene into a file, from the command line (DESIGN.md, Commands). Opens no device.
#include "app/interrupt.h"
#include "app/stage.h"
#include "bake/bake_file.h"
#include "bake/baker.h"
#include "bake/statics.h"
#include "base/error.h"
#include "base/log.h"
#include "scene/populate.h"
#include "tools/bake/memory.h"
#include "tools/bake/options.h"
#include "tools/bake/processes.h"
#include "tools/bake/progress_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace antumbra::baking {

namespace {

/// What is baked; the surfaces refer to the assets.
struct Static
{
    scene::Assets assets;
    bake::StaticScene surfaces;
};

void load(const scene::SceneFile& file, const Options& options, const bake::BakeSettings& settings, Static& result)
{
    ecs::World world;
    scene::populate(world, result.assets, file);
    const bake::Statics statics = bake::staticsOf(world, result.assets);
    if (statics.objects.empty())
        throw Error("nothing to bake: nothing in the scene is StaticPRT", options.scene);
    const bake::AtlasSettings atlas{.texelsPerMetre = settings.texelsPerMetre, .mostTexels = settings.mostTexels};
    result.surfaces = bake::flatten(statics.objects, bake::layOut(statics.objects, atlas));
}

double mebibytes(uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

void checkMemory(const Static& statics, const bake::BakeSettings& settings, const Options& options, uint64_t loadedBytes,
                 const bake::BakeEstimate& estimate)
{
    if (!options.mostBytes || loadedBytes + estimate.bytes <= *options.mostBytes)
        return;
    const uint64_t left = *options.mostBytes - std::min(*options.mostBytes, loadedBytes);
    const std::optional<float> density = bake::densityWithin(statics.surfaces, settings, left);
    const std::string advice =
        density ? fmt::format("--set prt.density={:.3g} would fit", std::floor(100 * *density) / 100) : "no density of texels would fit";
    throw Error(fmt::format("takes about {:.0f} MiB, more than the limit of {:.0f}; {}", mebibytes(loadedBytes + estimate.bytes),
                            mebibytes(*options.mostBytes), advice),
                options.scene);
}

ExitCode bakeWith(const Options& options, const Processes& processes)
{
    const app::InterruptGuard interrupt;
    const auto isInterrupted = [&interrupt] { return interrupt.isInterrupted(); };
    const auto started = std::chrono::steady_clock::now();
    const scene::SceneFile file = app::findScene(options.scene, {});
    const bake::BakeSettings settings = settingsOf(file.settings, options.settings);
    Static statics;
    load(file, options, settings, statics);
    const uint64_t loadedBytes = residentBytes();
    const bake::BakeEstimate estimate = bake::estimate(statics.surfaces, settings);
    checkMemory(statics, settings, options, loadedBytes, estimate);

    const Path partial = options.output.string() + ".partial";
    const uint32_t cores = std::max(std::thread::hardware_concurrency() / processes.countHere(), 1u);
    std::optional<bake::Bake> bake;
    {
        ProgressBar bar;
        bake = bake::bakeScene(statics.surfaces, settings,
                               {.threads = options.threads != 0 ? options.threads : cores,
                                .peers = processes.peers(isInterrupted),
                                .partial = partial,
                                .isResumed = options.isResumed,
                                .report = [&bar](const bake::BakeProgress& progress) { bar.show(progress); },
                                .isInterrupted = isInterrupted});
    }
    if (processes.rank() != 0)
        return bake ? ExitCode::Done : ExitCode::CheckFailed;
    if (!bake) {
        logWarning("interrupted: what is done is kept in {}; the same command with --resume goes on from it", partial.string());
        return ExitCode::CheckFailed;
    }
    bake::saveBake(options.output, *bake);
    std::filesystem::remove(partial);
    const glm::uvec3 cells = bake->volume.grid.count;
    fmt::print("{}: {} x {} texels, {} x {} x {} cells, {:.1f} MiB; {:.1f} s, {:.0f} MiB of memory at the peak, {:.0f} MiB estimated\n",
               options.output.string(), bake->atlas.extent.x, bake->atlas.extent.y, cells.x, cells.y, cells.z,
               mebibytes(std::filesystem::file_size(options.output)),
               std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count(), mebibytes(peakBytes()),
               mebibytes(loadedBytes + estimate.bytes));
    return ExitCode::Done;
}

} // namespace
} // namespace antumbra::baking

int main(int argc, char** argv)
{
    using namespace antumbra;
    const baking::Processes processes;
    try {
        const std::optional<baking::Options> options = baking::parse(argc, argv);
        return static_cast<int>(options ? baking::bakeWith(*options, processes) : ExitCode::Done);
    } catch (const Error& error) {
        // Most mistakes are found by all of them: the first says so, and the others when it did not end them.
        if (processes.rank() != 0)
            std::this_thread::sleep_for(std::chrono::seconds(1));
        logError("{}", error.what());
        processes.abort(static_cast<int>(error.code));
    }
}
