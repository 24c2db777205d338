// The two ways to play: in a window at the player's pace, and without one as fast as it goes. A script moves the stage one step a
// picture in both; a person's steps keep to the clock, however many pictures there are.
#pragma once

#include "app/interrupt.h"
#include "app/playback.h"

#include <functional>
#include <optional>

namespace antumbra::app {

/// How many steps are due: one each kStepSeconds. What a slow machine cannot make up for is dropped, so time slows down with it.
class StepClock
{
public:
    uint32_t advance(double seconds);

private:
    static constexpr uint32_t kMostSteps = 4; // a picture

    double owed_ = 0;
};

/// Until the window is closed, somebody quits, the script or `frames` pictures are over. Returns the number of pictures.
uint64_t playInWindow(Playback& playback, Window& window, gpu::Swapchain& swapchain, const Script* script, std::optional<uint32_t> frames,
                      const InterruptGuard& interrupt);

/// `frames` steps, each with its picture; `onPicture` is called after each with its number. Beyond the script nothing is asked.
/// Returns the number of pictures.
uint64_t playHeadless(Playback& playback, const Script& script, uint32_t frames, const std::function<void(uint32_t)>& onPicture,
                      const InterruptGuard& interrupt);

} // namespace antumbra::app
