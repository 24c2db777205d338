// `antumbra play`: a window where there is a display, else headless.
#include "app/baking.h"
#include "app/commands.h"
#include "app/main_loop.h"
#include "bake/bake_file.h"
#include "base/file.h"
#include "base/log.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <unistd.h>

namespace antumbra::app {

namespace {

constexpr uint64_t kSeed = 1; // where no script says otherwise
constexpr uint32_t kWalkFrames = 120;
constexpr vec3 kLoadingColor{0.10f, 0.11f, 0.13f};

std::unique_ptr<Window> openWindow(const PlayOptions& options)
{
    if (options.headless)
        return nullptr;
    std::unique_ptr<Window> window = Window::open(options.size.value_or(uvec2(640, 360)), "Antumbra: loading " + options.scene);
    if (!window)
        logInfo("no display: playing headless");
    return window;
}

PlaybackOptions playbackOptions(const PlayOptions& options, uvec2 size)
{
    return {.sceneName = options.scene,
            .size = size,
            .settings = options.settings,
            .targetMilliseconds = options.targetMilliseconds,
            .isRecording = options.record.has_value()};
}

std::string inMilliseconds(std::optional<double> time) { return time ? fmt::format("{:9.2f}", *time) : fmt::format("{:>9}", "-"); }

void printRow(std::string_view name, const SampleWindow& times)
{
    fmt::print("{:<28}{}{}{}\n", name, inMilliseconds(times.median()), inMilliseconds(times.least()), inMilliseconds(times.greatest()));
}

void printTable(const Playback& playback)
{
    const Profiler& profiler = playback.profiler();
    fmt::print("{:<28}{:>9}{:>9}{:>9}\n", "pass, milliseconds", "median", "least", "greatest");
    for (const PassTimes& pass : profiler.passes())
        printRow(pass.name, pass.milliseconds);
    printRow("frame", profiler.frameMilliseconds());
    if (const std::optional<double> median = profiler.frameMilliseconds().median(); median && *median > 0)
        fmt::print("{:.1f} frames a second\n", 1000 / *median);
}

/// What both ways to play leave behind.
void finish(Playback& playback, const PlayOptions& options, const Script& script)
{
    if (options.screenshot)
        playback.savePicture(*options.screenshot);
    if (options.record)
        writeText(*options.record, scriptText({.seed = script.seed, .steps = playback.recording().steps}));
    fmt::print("state {:016x} after {} steps\n", playback.stage().stateHash(), playback.stage().stepCount());
}

void playWithWindow(const PlayOptions& options, Window& window, Stage& stage, const Script& script)
{
    gpu::Device device({.windowExtensions = Window::vulkanExtensions()});
    gpu::Swapchain swapchain(device, window.handle());
    swapchain.showColor(kLoadingColor);
    PlaybackOptions how = playbackOptions(options, glm::max(swapchain.windowExtent(), uvec2(1)));
    how.showsOverlay = !options.script;
    how.waitsForPipelines = options.script.has_value();
    Playback playback(device, stage, how);
    playback.warmUp();
    window.setTitle("Antumbra: " + options.scene);
    const InterruptGuard interrupt;
    playInWindow(playback, window, swapchain, options.script ? &script : nullptr, options.frames, interrupt);
    finish(playback, options, script);
}

void playWithoutWindow(const PlayOptions& options, Stage& stage, const Script& script)
{
    const uint32_t frames = options.frames.value_or(options.script ? static_cast<uint32_t>(script.steps.size()) : kWalkFrames);
    gpu::Device device({});
    PlaybackOptions how = playbackOptions(options, options.size.value_or(uvec2(640, 360)));
    how.measuredFrames = std::max<size_t>(frames, 1);
    Playback playback(device, stage, how);
    playback.warmUp();

    const Path folder = projectPath("out");
    std::vector<Path> files;
    const auto keep = [&](uint32_t frame) {
        if (frame != 0 && frame != frames / 2 && frame + 1 != frames)
            return;
        files.push_back(folder / fmt::format("play_{:04}.png", frame));
        playback.savePicture(files.back());
    };
    const InterruptGuard interrupt;
    const uint64_t pictures = playHeadless(playback, script, frames, keep, interrupt);
    files.push_back(folder / "stats.json");
    writeText(files.back(), playback.stats(pictures));
    printTable(playback);
    for (const Path& file : files)
        fmt::print("{}\n", file.string());
    finish(playback, options, script);
}

/// Whether somebody sits there and wants the bake that is missing.
bool wantsBake(const std::string& fault)
{
    if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0)
        return false;
    fmt::print(stderr, "{}\nBake its light now? It takes minutes, Ctrl-C keeps what is done. [y/N] ", fault);
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "Y" || answer == "yes";
}

/// With baked light where there is some, or somebody waits for it.
Stage openStage(const PlayOptions& options, uint64_t seed, Gameplay gameplay)
{
    const scene::SceneFile scene = findScene(options.scene, options.settings);
    Stage stage(scene, seed, gameplay, options.settings);
    if (!stage.bakedLight().fault.empty() && wantsBake(stage.bakedLight().fault)) {
        const Path output = bake::bakePathOf(scene.file);
        const InterruptGuard interrupt;
        if (bakeToFile({.scene = scene,
                        .settings = bakeSettingsOf(scene, options.settings),
                        .output = output,
                        .isResumed = std::filesystem::exists(partialOf(output))},
                       interrupt))
            return Stage(scene, seed, gameplay, options.settings);
    }
    warnOfMissingBake(stage.bakedLight(), options.scene);
    return stage;
}

} // namespace

ExitCode runPlay(const PlayOptions& options, Gameplay gameplay)
{
    const std::unique_ptr<Window> window = openWindow(options);
    const bool isScripted = options.script || !window;
    const Script script =
        isScripted ? loadScript(options.script.value_or(projectPath("assets") / "scripts" / "walk.jsonl")) : Script{.seed = kSeed};
    Stage stage = openStage(options, script.seed, gameplay);
    if (window)
        playWithWindow(options, *window, stage, script);
    else
        playWithoutWindow(options, stage, script);
    return ExitCode::Done;
}

} // namespace antumbra::app
