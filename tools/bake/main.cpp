// bake SCENE: the light of a scene into a file, from the command line (DESIGN.md, Commands). Opens no device.
#include "app/baked_light.h"
#include "app/baking.h"
#include "app/stage.h"
#include "base/error.h"
#include "base/log.h"
#include "tools/bake/options.h"
#include "tools/bake/processes.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace antumbra::baking {

namespace {

ExitCode bakeWith(const Options& options, const Processes& processes)
{
    const app::InterruptGuard interrupt;
    const scene::SceneFile scene = app::findScene(options.scene, options.settings);
    const uint32_t cores = std::max(std::thread::hardware_concurrency() / processes.countHere(), 1u);
    const bool isDone = bakeToFile({.scene = scene,
                                    .settings = app::bakeSettingsOf(scene, options.settings),
                                    .output = options.output,
                                    .threads = options.threads != 0 ? options.threads : cores,
                                    .mostBytes = options.mostBytes,
                                    .isResumed = options.isResumed,
                                    .peers = processes.peers([&interrupt] { return interrupt.isInterrupted(); })},
                                   interrupt);
    return isDone ? ExitCode::Done : ExitCode::CheckFailed;
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
