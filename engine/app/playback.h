// A stage and its pictures: performs steps and draws frames in the same way whether a person or a script asks, so that what was
// recorded replays to the same bytes. Has no window and keeps no time: see main_loop.h.
#pragma once

#include "app/panels.h"
#include "app/quality.h"
#include "app/script.h"
#include "app/stage.h"
#include "app/window.h"
#include "gpu/swapchain.h"

#include <optional>

namespace antumbra::app {

/// Which defaults a device gets.
render::DeviceClass deviceClassOf(const gpu::DeviceInfo& device);

struct PlaybackOptions
{
    std::string sceneName;
    uvec2 size{640, 360};                     // pixels
    render::Settings settings;                // over the scene file's
    std::optional<double> targetMilliseconds; // a frame
    bool isRecording = false;
    bool showsOverlay = false;
    bool waitsForPipelines = true;                  // as FrameView has it: the same pictures at every run
    size_t measuredFrames = Profiler::kShownFrames; // that statistics are over
};

class Playback
{
public:
    /// Frames drawn before the first counts: they make pipelines and fill caches.
    static constexpr uint32_t kWarmUpFrames = 8;

    Playback(gpu::Device& device, Stage& stage, const PlaybackOptions& options);

    void warmUp();
    /// One step of the simulation.
    void perform(const ScriptStep& step);
    /// One picture of where things stand, into `target` too where there is one. `pointer` works the overlay; null: nobody does.
    void draw(float seconds, const Pointer* pointer, const gpu::WindowImage* target);
    /// The time of the last picture, by the caller's clock, and how much of it went by waiting for the display.
    void measure(double frameMilliseconds, double waitMilliseconds = 0);

    void resize(uvec2 extent) { renderer_.resize(extent); }
    /// The last picture, in a file.
    void savePicture(const Path& file);

    /// The overlay has the mouse.
    [[nodiscard]] bool holdsPointer() const;
    [[nodiscard]] bool wantsToQuit() const { return wantsToQuit_; }
    [[nodiscard]] const Script& recording() const { return recording_; }
    [[nodiscard]] const Stage& stage() const { return stage_; }
    [[nodiscard]] const Profiler& profiler() const { return profiler_; }
    [[nodiscard]] const render::Knobs& knobs() const { return knobs_; }
    [[nodiscard]] render::Renderer& renderer() { return renderer_; }
    /// The stats JSON of the frames measured so far.
    [[nodiscard]] std::string stats(uint64_t frames) const;

private:
    void obey(const InputFrame& input);
    void record(const ScriptStep& step);
    void buildOverlay(float seconds, const Pointer* pointer);
    [[nodiscard]] const QualityControl* quality() const { return quality_ ? &*quality_ : nullptr; }

    Stage& stage_;
    gpu::DeviceInfo device_;
    std::string sceneName_;
    render::Knobs knobs_;
    uint32_t splitColumn_ = 0;
    render::Renderer renderer_;
    render::FrameView view_;
    Panels panels_;
    Profiler profiler_;
    std::optional<QualityControl> quality_;
    std::vector<KeyLine> keyLines_;
    std::vector<KeyHint> keyHints_; // of keyLines_
    bool showsKeys_ = true;
    bool wantsToQuit_ = false;
    bool wantsScreenshot_ = false;
    bool isRecording_ = false;
    Script recording_;
    render::Knobs recordedKnobs_; // as a replay would have them so far
    uint32_t recordedSplit_ = 0;
};

} // namespace antumbra::app
