#include "tools/lab/bench.h"

#include "app/playback.h"
#include "tools/lab/stopwatch.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace antumbra::lab {

namespace {

constexpr float kStirSeconds = 1e-3f; // to and fro: every frame has another pose, and none is far from the point's time
constexpr float kTurnRadians = 1e-3f; // so does the light

// The first frame after a change of knobs makes buffers, and a frame is reported when the device is done with it.
constexpr uint32_t kFramesToSettle = 1 + gpu::kFramesInFlight;

constexpr std::string_view kSceneKnobs[] = {"crowd.", "gallery."}; // that entities are made by

struct Counter
{
    std::string_view name;
    shader::uint shader::CounterBlock::*value;
};

constexpr std::array kCounters{Counter{"rays_considered", &shader::CounterBlock::raysConsidered},
                               Counter{"rays_traced", &shader::CounterBlock::raysTraced},
                               Counter{"cones", &shader::CounterBlock::cones},
                               Counter{"pieces", &shader::CounterBlock::pieces},
                               Counter{"light_vertices", &shader::CounterBlock::lightVertices},
                               Counter{"silhouette_vertices", &shader::CounterBlock::silhouetteVertices},
                               Counter{"fallback_pixels", &shader::CounterBlock::fallbackPixels},
                               Counter{"clamped_pixels", &shader::CounterBlock::clampedPixels},
                               Counter{"nan_pixels", &shader::CounterBlock::nanPixels},
                               Counter{"inf_pixels", &shader::CounterBlock::infPixels},
                               Counter{"negative_pixels", &shader::CounterBlock::negativePixels}};

/// What the scene was loaded with.
render::Settings loadedWith(const app::SweepPoint& point)
{
    render::Settings settings;
    std::ranges::copy_if(point.settings, std::back_inserter(settings), [](const auto& setting) {
        return std::ranges::any_of(kSceneKnobs, [&](std::string_view prefix) { return setting.first.starts_with(prefix); });
    });
    return settings;
}

} // namespace

Bench::Bench(gpu::Device& device, const app::SweepPoint& point)
    : point_(point), deviceClass_(app::deviceClassOf(device.info())),
      stage_(app::findScene(point.scene, point.settings), 0, app::noGameplay, point.settings),
      renderer_(device, stage_.assets(), point.size)
{
    advance(point.seconds);
}

bool Bench::fits(const app::SweepPoint& point) const
{
    return point.scene == point_.scene && point.size == point_.size && point.seconds == point_.seconds &&
           point.hasCharacters == point_.hasCharacters && loadedWith(point) == loadedWith(point_);
}

render::Knobs Bench::resolve(const app::SweepPoint& point) const
{
    return render::resolveKnobs(deviceClass_, stage_.settings(), point.settings);
}

render::Settings Bench::knobsOf(const app::SweepPoint& point) const { return render::valuesOf(resolve(point)); }

void Bench::advance(float seconds)
{
    stage_.advanceClips(seconds);
    stage_.extract(view_);
    if (!point_.hasCharacters)
        view_.characters.clear();
}

double Bench::draw()
{
    return millisecondsOf([&] { renderer_.render(view_); });
}

double Bench::warmUp(const app::SweepPoint& point, uint32_t frames)
{
    view_.knobs = resolve(point);
    const size_t builds = (view_.characters.size() + view_.knobs.occlusion.builds - 1) / view_.knobs.occlusion.builds;
    double milliseconds = 0;
    for (size_t frame = 0; frame < builds + frames; ++frame)
        milliseconds = draw();
    return milliseconds;
}

bool Bench::accumulate(uint32_t samples, const app::InterruptGuard& interrupt, const std::function<void(uint32_t)>& tell)
{
    view_.knobs = resolve(point_);
    view_.knobs.reference.samples = samples;
    view_.knobs.area.shadow = scene::LightShadow::Reference;
    do {
        if (interrupt.isInterrupted())
            return false;
        draw();
        tell(renderer_.referenceSamples().value_or(samples));
    } while (renderer_.referenceSamples().value_or(samples) < samples); // where nothing accumulates, the picture is the truth
    constexpr std::array aovs{render::Aov::Irradiance, render::Aov::Unshadowed, render::Aov::Depth};
    renderer_.capture(aovs);
    draw();
    truth_ = {.irradiance = renderer_.captured(render::Aov::Irradiance),
              .unshadowed = renderer_.captured(render::Aov::Unshadowed),
              .depth = renderer_.captured(render::Aov::Depth)};
    if (!view_.areaLights.empty())
        truth_.unshadowed = unshadowedByLights();
    return true;
}

scene::ImageF Bench::unshadowedByLights()
{
    view_.knobs.area.shadow = scene::LightShadow::None;
    constexpr std::array aovs{render::Aov::Irradiance};
    renderer_.capture(aovs);
    draw();
    return renderer_.captured(render::Aov::Irradiance);
}

app::ImageError Bench::errorOf(const app::SweepPoint& point)
{
    view_.knobs = resolve(point);
    constexpr std::array aovs{render::Aov::Irradiance};
    renderer_.capture(aovs);
    draw();
    return app::errorOf(renderer_.captured(render::Aov::Irradiance), truth_);
}

void Bench::addFrame(Samples& samples, double milliseconds) const
{
    const render::FrameReport report = renderer_.report();
    push(samples.times, "frame", milliseconds);
    push(samples.times, "device frame", report.frameMilliseconds);
    for (const graph::PassTime& pass : report.passes)
        push(samples.times, pass.name, pass.milliseconds);
    for (const Counter& counter : kCounters)
        push(samples.counters, counter.name, report.counters.*counter.value);
}

uint32_t Bench::framesOf(const app::SweepPoint& point) { return kFramesToSettle + point.frames; }

std::optional<Samples> Bench::measure(const app::SweepPoint& point, const app::InterruptGuard& interrupt)
{
    view_.knobs = resolve(point);
    Samples samples;
    float away = 0; // from the point's time
    for (uint32_t frame = 0; frame < framesOf(point) && !interrupt.isInterrupted(); ++frame) {
        if (point.animates) {
            const float stir = away > 0 ? -kStirSeconds : kStirSeconds;
            advance(stir);
            away += stir;
        }
        if (point.turnsLight)
            view_.environment.rotationRadians += frame % 2 == 0 ? kTurnRadians : -kTurnRadians;
        const double milliseconds = draw();
        if (frame >= kFramesToSettle)
            addFrame(samples, milliseconds);
    }
    advance(-away);
    return interrupt.isInterrupted() ? std::nullopt : std::optional(samples);
}

} // namespace antumbra::lab
