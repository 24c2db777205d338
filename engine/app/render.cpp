// `antumbra render`: one moment of a scene, drawn as often as asked, written once.
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/light_visibility.h"
#include "app/playback.h"
#include "app/stats.h"
#include "base/file.h"
#include "base/log.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace antumbra::app {

namespace {

using Clock = std::chrono::steady_clock;

struct Wanted
{
    render::Aov aov;
    Path file;
};

std::vector<Wanted> wantedAovs(const RenderOptions& options)
{
    std::vector<Wanted> wanted;
    for (const AovOutput& output : options.aovs) {
        if (lightOfAov(output.name))
            continue;
        const std::optional<render::Aov> aov = render::aovOf(output.name);
        if (!aov)
            throw Error("no such AOV; there are color, irradiance, unshadowed, occluded, albedo, normal, depth, cones and visibility:LIGHT",
                        output.name);
        wanted.push_back({*aov, output.file});
    }
    if (options.output.extension() == ".exr")
        wanted.push_back({render::Aov::Color, options.output});
    return wanted;
}

/// A renderer before one unmoving view.
class Still
{
public:
    Still(gpu::Device& device, const RenderOptions& options)
        : stage_(findScene(options.scene, options.settings), 0, noGameplay, options.settings),
          renderer_(device, stage_.assets(), options.size), profiler_(options.frames)
    {
        warnOfMissingBake(stage_.bakedLight(), options.scene);
        stage_.advanceClips(static_cast<float>(options.seconds));
        stage_.extract(view_);
        view_.knobs = render::resolveKnobs(deviceClassOf(device.info()), stage_.settings(), options.settings);
    }

    void draw()
    {
        const Clock::time_point start = Clock::now();
        renderer_.render(view_);
        milliseconds_ = 1000 * std::chrono::duration<double>(Clock::now() - start).count();
    }
    void measure() { profiler_.record(renderer_.report(), milliseconds_); }

    /// Pipelines are made, caches filled, and every pose built: those of a crowd take several frames.
    void warmUp()
    {
        const size_t builds = (view_.characters.size() + view_.knobs.occlusion.builds - 1) / view_.knobs.occlusion.builds;
        for (size_t frame = 0; frame < builds + Playback::kWarmUpFrames; ++frame)
            draw();
    }

    /// Until the reference has all of its samples, or somebody has enough.
    void accumulate(const InterruptGuard& interrupt)
    {
        const uint32_t wanted = view_.knobs.reference.samples;
        Clock::time_point told = Clock::now();
        const auto samples = [&] { return renderer_.referenceSamples().value_or(wanted); };
        while (samples() < wanted && !interrupt.isInterrupted()) {
            draw();
            if (Clock::now() - told > std::chrono::seconds(2)) {
                told = Clock::now();
                logInfo("reference: {} of {} samples", samples(), wanted);
            }
        }
        if (samples() < wanted)
            logWarning("interrupted: the reference has {} of {} samples", samples(), wanted);
    }

    render::Renderer& renderer() { return renderer_; }
    [[nodiscard]] uint32_t lightNamed(const std::string& name) const { return app::lightNamed(stage_.world(), view_, name); }

    /// Of the diffuse irradiance that the light would give without shadows, the share that there is.
    scene::ImageF visibilityOf(uint32_t light, const InterruptGuard& interrupt)
    {
        const render::FrameView whole = std::exchange(view_, viewOfLight(view_, light));
        draw(); // forgets what the reference has of all lights
        accumulate(interrupt);
        const scene::ImageF lit = captured(render::Aov::Irradiance);
        view_.areaLights[0].shadow = scene::LightShadow::None;
        const scene::ImageF unshadowed = captured(render::Aov::Irradiance);
        view_ = whole;
        return shareOf(lit, unshadowed);
    }

    [[nodiscard]] std::string stats(const gpu::DeviceInfo& device, const RenderOptions& options) const
    {
        return statsJson({.device = device.name,
                          .driver = device.driver,
                          .scene = options.scene,
                          .size = options.size,
                          .frames = options.frames,
                          .knobs = view_.knobs,
                          .profiler = profiler_,
                          .report = renderer_.report(),
                          .memory = renderer_.memory()});
    }

private:
    scene::ImageF captured(render::Aov aov)
    {
        renderer_.capture({&aov, 1});
        draw();
        return renderer_.captured(aov);
    }

    Stage stage_;
    render::Renderer renderer_;
    render::FrameView view_;
    Profiler profiler_;
    double milliseconds_ = 0;
};

/// The picture and what was asked for beside it, from the frame that is drawn here.
void drawAndSave(Still& still, const RenderOptions& options, const std::vector<Wanted>& wanted)
{
    std::vector<render::Aov> aovs;
    for (const Wanted& each : wanted)
        aovs.push_back(each.aov);
    still.renderer().capture(aovs);
    still.draw();
    for (const Wanted& each : wanted)
        scene::saveExr(each.file, still.renderer().captured(each.aov));
    if (options.output.extension() == ".png")
        scene::savePng(options.output, still.renderer().picture());
}

void measureAndSave(Still& still, const RenderOptions& options, const gpu::DeviceInfo& device, const InterruptGuard& interrupt)
{
    // A frame is reported once the device is done with it, and the one before also copied what was captured.
    for (uint32_t frame = 0; frame < gpu::kFramesInFlight; ++frame)
        still.draw();
    for (uint32_t frame = 0; frame < options.frames && !interrupt.isInterrupted(); ++frame) {
        still.draw();
        still.measure();
    }
    writeText(*options.stats, still.stats(device, options));
}

/// A light of the view and the file that its visibility goes to.
using WantedLight = std::pair<uint32_t, Path>;

std::vector<WantedLight> wantedLights(const RenderOptions& options, const Still& still)
{
    std::vector<WantedLight> wanted;
    for (const AovOutput& output : options.aovs)
        if (const std::optional<std::string> light = lightOfAov(output.name))
            wanted.emplace_back(still.lightNamed(*light), output.file);
    return wanted;
}

} // namespace

ExitCode runRender(const RenderOptions& options)
{
    const std::vector<Wanted> wanted = wantedAovs(options);
    gpu::Device device({});
    Still still(device, options);
    const std::vector<WantedLight> lights = wantedLights(options, still);
    const InterruptGuard interrupt;
    still.warmUp();
    still.accumulate(interrupt);
    drawAndSave(still, options, wanted);
    if (options.stats)
        measureAndSave(still, options, device.info(), interrupt);
    for (const auto& [light, file] : lights)
        scene::saveExr(file, still.visibilityOf(light, interrupt));
    return ExitCode::Done;
}

} // namespace antumbra::app
