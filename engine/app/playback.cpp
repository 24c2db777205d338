#include "app/playback.h"

#include "app/light_lines.h"
#include "app/stats.h"
#include "base/log.h"

#include <imgui.h>

#include <algorithm>
#include <fmt/format.h>

namespace antumbra::app {

namespace {

constexpr std::string_view kLateFields = "compiling changed distance fields; the last ones stay meanwhile";
constexpr size_t kViewCount = static_cast<size_t>(render::ViewMode::Reference) + 1;

std::vector<KeyHint> hintsOf(const std::vector<KeyLine>& lines)
{
    std::vector<KeyHint> hints;
    for (const KeyLine& line : lines)
        hints.push_back({.key = line.keys, .what = line.what});
    return hints;
}

void hand(const Pointer* pointer, ImGuiIO& io)
{
    const Pointer nobody;
    const Pointer& mouse = pointer != nullptr ? *pointer : nobody;
    io.MousePos = {mouse.position.x, mouse.position.y};
    std::ranges::copy(mouse.isHeld, io.MouseDown);
    io.MouseWheel = mouse.wheel;
}

} // namespace

render::DeviceClass deviceClassOf(const gpu::DeviceInfo& device)
{
    return device.isCpu ? render::DeviceClass::Cpu : render::DeviceClass::Gpu;
}

Playback::Playback(gpu::Device& device, Stage& stage, const PlaybackOptions& options)
    : stage_(stage), device_(device.info()), sceneName_(options.sceneName),
      knobs_(render::resolveKnobs(deviceClassOf(device_), stage.settings(), options.settings)),
      renderer_(device, stage.assets(), options.size), profiler_(options.measuredFrames), keyLines_(keyLines()),
      keyHints_(hintsOf(keyLines_)), isRecording_(options.isRecording),
      recordedKnobs_(render::resolveKnobs(deviceClassOf(device_), stage.settings(), {}))
{
    if (options.targetMilliseconds)
        quality_.emplace(*options.targetMilliseconds, render::resolveKnobs(render::DeviceClass::Gpu, stage.settings(), options.settings),
                         knobs_);
    view_.waitsForPipelines = options.waitsForPipelines;
    if (panels_.areVisible() != options.showsOverlay)
        panels_.toggle();
}

void Playback::warmUp()
{
    for (uint32_t frame = 0; frame < kWarmUpFrames; ++frame)
        draw(kStepSeconds, nullptr, nullptr);
    profiler_.clear();
}

void Playback::perform(const ScriptStep& step)
{
    for (const auto& [key, value] : step.settings)
        render::set(knobs_, key, value);
    if (step.splitColumn)
        splitColumn_ = *step.splitColumn;
    if (isRecording_)
        record(step);
    obey(step.input);
    stage_.step(step.input);
}

void Playback::record(const ScriptStep& step)
{
    // What the overlay changed since the last step was nobody's input: it is written as settings of this one.
    ScriptStep recorded{.input = step.input};
    for (const render::KnobDescription& knob : render::knobTable())
        if (knob.read(knobs_) != knob.read(recordedKnobs_))
            recorded.settings.emplace_back(knob.key, render::get(knobs_, knob.key));
    if (splitColumn_ != recordedSplit_)
        recorded.splitColumn = splitColumn_;
    recordedKnobs_ = knobs_;
    recordedSplit_ = splitColumn_;
    recording_.steps.push_back(std::move(recorded));
}

void Playback::obey(const InputFrame& input)
{
    if (input.asks(Action::ToggleOverlay))
        panels_.toggle();
    if (input.asks(Action::ToggleKeys))
        showsKeys_ = !showsKeys_;
    if (input.asks(Action::NextView)) {
        knobs_.view = static_cast<render::ViewMode>((static_cast<size_t>(knobs_.view) + 1) % kViewCount);
        recordedKnobs_.view = knobs_.view; // the action is recorded already
    }
    if (input.asks(Action::Screenshot))
        wantsScreenshot_ = true;
    if (input.asks(Action::Quit))
        wantsToQuit_ = true;
}

bool Playback::holdsPointer() const { return panels_.areVisible() && ImGui::GetIO().WantCaptureMouse; }

void Playback::buildOverlay(float seconds, const Pointer* pointer)
{
    hand(pointer, ImGui::GetIO());
    renderer_.overlay().begin(renderer_.extent(), seconds);
    const render::FrameReport report = renderer_.report();
    const render::MemoryReport memory = renderer_.memory();
    panels_.build({.device = device_.name,
                   .scene = sceneName_,
                   .profiler = profiler_,
                   .report = report,
                   .memory = memory,
                   .quality = quality(),
                   .keys = showsKeys_ ? std::span<const KeyHint>(keyHints_) : std::span<const KeyHint>(),
                   .message = report.hasLateFields ? kLateFields : std::string_view()},
                  knobs_, splitColumn_);
    const bool isProbed = knobs_.area.isProbed && pointer != nullptr && !holdsPointer();
    const ivec2 pixel = isProbed ? ivec2(pointer->position) : ivec2(-1);
    const bool isInPicture = glm::all(glm::greaterThanEqual(pixel, ivec2(0))) && glm::all(glm::lessThan(pixel, ivec2(renderer_.extent())));
    view_.probedPixel = isInPicture ? std::optional(pixel) : std::nullopt;
    if (knobs_.area.isProbed)
        drawLightLines(renderer_.probeLines(), view_.camera, renderer_.extent());
    renderer_.overlay().end();
}

void Playback::draw(float seconds, const Pointer* pointer, const gpu::WindowImage* target)
{
    stage_.extract(view_);
    view_.knobs = knobs_;
    view_.splitColumn = splitColumn_;
    buildOverlay(seconds, pointer);
    if (target != nullptr)
        renderer_.render(view_, target->image, target->available, target->finished);
    else
        renderer_.render(view_);
    if (wantsScreenshot_) {
        wantsScreenshot_ = false;
        const Path file = projectPath("out") / fmt::format("screenshot_{:06}.png", stage_.stepCount());
        savePicture(file);
        logInfo("screenshot: {}", file.string());
    }
}

void Playback::measure(double frameMilliseconds, double waitMilliseconds)
{
    const render::FrameReport report = renderer_.report();
    profiler_.record(report, frameMilliseconds);
    // A display that makes us wait for its refresh takes no quality, but where it only seems so the device is what we waited for.
    const double busyMilliseconds = std::max(frameMilliseconds - waitMilliseconds, report.frameMilliseconds.value_or(0));
    if (quality_ && quality_->take(busyMilliseconds, knobs_))
        logInfo("{:.1f} ms a frame, {:.1f} wanted: quality {} of {} down, occlusion.samples {}, occlusion.scale {}",
                quality_->milliseconds(), quality_->targetMilliseconds(), quality_->level(), quality_->lowestLevel(),
                render::get(knobs_, "occlusion.samples"), render::get(knobs_, "occlusion.scale"));
}

void Playback::savePicture(const Path& file) { scene::savePng(file, renderer_.picture()); }

std::string Playback::stats(uint64_t frames) const
{
    return statsJson({.device = device_.name,
                      .driver = device_.driver,
                      .scene = sceneName_,
                      .size = renderer_.extent(),
                      .frames = frames,
                      .knobs = knobs_,
                      .quality = quality(),
                      .profiler = profiler_,
                      .report = renderer_.report(),
                      .memory = renderer_.memory()});
}

} // namespace antumbra::app
