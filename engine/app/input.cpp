#include "app/input.h"

#include <cmath>

namespace antumbra::app {

namespace {

constexpr float kRadiansPerPixel = 0.006f;
constexpr float kOrbitRadiansPerSecond = 1.6f;
constexpr float kNotchesPerSecond = 8;
constexpr float kDeadZone = 0.15f; // of a stick that nobody touches

using Axes = std::array<float, kAxisCount>;
using Sticks = std::array<float, kPadAxisCount>;

float& at(Axes& axes, Axis axis) { return axes[static_cast<size_t>(axis)]; }

// Of both axes of a stick together: taken one by one, they would pull a slanted stick towards the nearer axis.
vec2 beyondDeadZone(vec2 stick)
{
    const float length = glm::length(stick);
    return length <= kDeadZone ? vec2(0) : stick * (std::min(1.0f, (length - kDeadZone) / (1 - kDeadZone)) / length);
}

Sticks beyondDeadZones(const Sticks& sticks)
{
    const vec2 left = beyondDeadZone({sticks[0], sticks[1]}), right = beyondDeadZone({sticks[2], sticks[3]});
    return {left.x, left.y, right.x, right.y};
}

float strengthOf(const Control& control, const HandState& hands, const Sticks& sticks)
{
    if (control.stick != PadAxis::None)
        return sticks[static_cast<size_t>(control.stick)];
    const bool isKeyHeld = control.key != Key::None && hands.keysHeld[static_cast<size_t>(control.key)];
    const bool isButtonHeld = control.button != PadButton::None && hands.buttonsHeld[static_cast<size_t>(control.button)];
    return isKeyHeld || isButtonHeld ? 1.0f : 0.0f;
}

bool isPressed(const Control& control, const HandState& hands)
{
    return (control.key != Key::None && hands.keysPressed[static_cast<size_t>(control.key)]) ||
           (control.button != PadButton::None && hands.buttonsPressed[static_cast<size_t>(control.button)]);
}

Axes axesOf(const HandState& hands)
{
    const Sticks sticks = beyondDeadZones(hands.sticks);
    Axes axes{};
    for (const Control& control : controls())
        if (control.isHeld)
            at(axes, control.axis) += control.amount * strengthOf(control, hands, sticks);
    for (float& axis : axes)
        axis = glm::clamp(axis, -1.0f, 1.0f);
    return axes;
}

} // namespace

void Input::take(const HandState& hands)
{
    Axes axes = axesOf(hands);
    const vec2 move{at(axes, Axis::Right), at(axes, Axis::Ahead)};
    next_.move = move / std::max(1.0f, glm::length(move));
    next_.turnLight = at(axes, Axis::LightLeft);
    next_.isRunning = at(axes, Axis::Run) > 0.5f;
    orbit_ = vec2(at(axes, Axis::OrbitRight), at(axes, Axis::OrbitUp)) * kOrbitRadiansPerSecond;
    zoom_ = at(axes, Axis::Closer) * kNotchesPerSecond;
    // The hand holds the scene, so the camera goes the other way.
    next_.look -= hands.drag * kRadiansPerPixel;
    next_.zoom += hands.wheel;
    for (const Control& control : controls())
        if (!control.isHeld && isPressed(control, hands))
            next_.ask(control.action);
}

InputFrame Input::nextStep()
{
    InputFrame step = next_;
    step.look += orbit_ * kStepSeconds;
    step.zoom += zoom_ * kStepSeconds;
    next_.look = vec2(0);
    next_.zoom = 0;
    next_.pressed = 0;
    return step;
}

} // namespace antumbra::app
