// What one step of the simulation is asked to do, whoever asks: a person (input.h) or a script (script.h). Actions, never keys.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace antumbra::app {

/// One step of the simulation, in seconds of the player's time.
inline constexpr float kStepSeconds = 1.0f / 60;

/// What is done once, when it is asked for.
enum class Action : uint8_t {
    Wave,
    ChangeCamera, // between following and orbiting
    Pause,
    SingleStep,
    Slower,
    Faster,
    ToggleOverlay,
    ToggleKeys,
    NextView,
    Screenshot,
    Quit,
};
inline constexpr uint32_t kActionCount = 11;

/// `move`, `turnLight` and `isRunning` are held, the rest belongs to this step alone.
struct InputFrame
{
    vec2 move{0};        // to the right and ahead, as the camera sees it; at most 1 long
    float turnLight = 0; // -1 to 1, counter-clockwise seen from above
    bool isRunning = false;
    vec2 look{0};         // radians the camera goes around its target: to the right and up
    float zoom = 0;       // notches towards the target
    uint32_t pressed = 0; // a bit for each Action

    [[nodiscard]] bool asks(Action action) const { return (pressed >> static_cast<uint32_t>(action) & 1u) != 0; }
    void ask(Action action) { pressed |= 1u << static_cast<uint32_t>(action); }

    friend bool operator==(const InputFrame&, const InputFrame&) = default;
};

} // namespace antumbra::app
