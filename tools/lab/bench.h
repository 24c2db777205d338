// One scene at one size and one time, ready to be drawn with any knobs: what the lab takes its figures from. Keeps none of them.
#pragma once

#include "app/interrupt.h"
#include "app/measure.h"
#include "app/stage.h"
#include "app/sweep.h"
#include "render/renderer.h"
#include "tools/lab/samples.h"

#include <functional>

namespace antumbra::lab {

class Bench
{
public:
    /// Throws Error for a scene that does not load.
    Bench(gpu::Device& device, const app::SweepPoint& point);

    /// The point can be measured here: same scene as it is loaded, size and time.
    [[nodiscard]] bool fits(const app::SweepPoint& point) const;
    /// Every knob as the point has it.
    [[nodiscard]] render::Settings knobsOf(const app::SweepPoint& point) const;

    /// Makes pipelines, fills caches, builds every pose. Returns the milliseconds of the last of at least `frames` frames.
    double warmUp(const app::SweepPoint& point, uint32_t frames);
    /// Draws the truth: that of area lights too, but for those that say themselves how they are shadowed. False where it was interrupted:
    /// there is then none. `tell` is called after each frame with the samples so far.
    bool accumulate(uint32_t samples, const app::InterruptGuard& interrupt, const std::function<void(uint32_t)>& tell);
    /// After accumulate().
    [[nodiscard]] app::ImageError errorOf(const app::SweepPoint& point);
    /// Times, of which the first are "frame" by the host's clock and "device frame", and counters of as many frames as the point says;
    /// nothing where it was interrupted.
    std::optional<Samples> measure(const app::SweepPoint& point, const app::InterruptGuard& interrupt);

    /// That measure() draws; some of them to settle after what was drawn before.
    [[nodiscard]] static uint32_t framesOf(const app::SweepPoint& point);

private:
    double draw();
    /// Irradiance with what area lights would give without shadows.
    scene::ImageF unshadowedByLights();
    void addFrame(Samples& samples, double milliseconds) const;
    void advance(float seconds);
    [[nodiscard]] render::Knobs resolve(const app::SweepPoint& point) const;

    app::SweepPoint point_; // the first of those that fit
    render::DeviceClass deviceClass_;
    app::Stage stage_;
    render::Renderer renderer_;
    render::FrameView view_;
    app::Truth truth_;
};

} // namespace antumbra::lab
