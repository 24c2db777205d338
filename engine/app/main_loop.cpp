#include "app/main_loop.h"

#include "app/input.h"

#include <chrono>
#include <thread>

namespace antumbra::app {

namespace {

using Clock = std::chrono::steady_clock;

// Not every display waits for its next refresh, so the loop does not rely on that.
constexpr std::chrono::nanoseconds kPicturePeriod{1'000'000'000 / 60};
constexpr std::chrono::milliseconds kMinimisedWait{100};

double secondsBetween(Clock::time_point from, Clock::time_point to) { return std::chrono::duration<double>(to - from).count(); }

/// What the hands do outside of the overlay.
HandState handsForGame(const Window& window, bool isPointerTaken)
{
    HandState hands = window.hands();
    if (isPointerTaken) {
        hands.drag = vec2(0);
        hands.wheel = 0;
    }
    return hands;
}

/// Draws into the window. Returns for how many seconds the display made it wait; nothing while there is nothing to draw into.
std::optional<double> show(Playback& playback, Window& window, gpu::Swapchain& swapchain, float seconds)
{
    const Clock::time_point start = Clock::now();
    const std::optional<gpu::WindowImage> target = swapchain.acquire();
    if (!target)
        return std::nullopt;
    const double waited = secondsBetween(start, Clock::now());
    playback.resize(target->image->info().extent);
    playback.draw(seconds, &window.pointer(), &*target);
    swapchain.present();
    return waited;
}

} // namespace

uint32_t StepClock::advance(double seconds)
{
    owed_ = std::min(owed_ + seconds / kStepSeconds, double{kMostSteps});
    const auto due = static_cast<uint32_t>(owed_);
    owed_ -= due;
    return due;
}

uint64_t playInWindow(Playback& playback, Window& window, gpu::Swapchain& swapchain, const Script* script, std::optional<uint32_t> frames,
                      const InterruptGuard& interrupt)
{
    Input input;
    StepClock steps;
    uint64_t pictures = 0;
    size_t scripted = 0; // steps
    Clock::time_point last = Clock::now();
    Clock::time_point next = last;
    const auto isOver = [&] {
        return window.wantsToClose() || playback.wantsToQuit() || interrupt.isInterrupted() || (frames && pictures >= *frames) ||
               (script != nullptr && scripted >= script->steps.size());
    };
    while (!isOver()) {
        window.poll();
        const Clock::time_point now = Clock::now();
        const double elapsed = secondsBetween(last, now);
        last = now;
        input.take(handsForGame(window, playback.holdsPointer()));
        if (script != nullptr)
            playback.perform(script->steps[scripted++]);
        else
            for (uint32_t due = steps.advance(elapsed); due > 0; --due)
                playback.perform({.input = input.nextStep()});
        if (const std::optional<double> waited = show(playback, window, swapchain, static_cast<float>(elapsed))) {
            playback.measure(1000 * secondsBetween(now, Clock::now()), 1000 * *waited);
            ++pictures;
        } else {
            std::this_thread::sleep_for(kMinimisedWait);
        }
        next = std::max(next + kPicturePeriod, now);
        std::this_thread::sleep_until(next);
    }
    return pictures;
}

uint64_t playHeadless(Playback& playback, const Script& script, uint32_t frames, const std::function<void(uint32_t)>& onPicture,
                      const InterruptGuard& interrupt)
{
    uint32_t frame = 0;
    for (; frame < frames && !playback.wantsToQuit() && !interrupt.isInterrupted(); ++frame) {
        const Clock::time_point start = Clock::now();
        playback.perform(frame < script.steps.size() ? script.steps[frame] : ScriptStep{});
        playback.draw(kStepSeconds, nullptr, nullptr);
        playback.measure(1000 * secondsBetween(start, Clock::now()));
        onPicture(frame);
    }
    return frame;
}

} // namespace antumbra::app
