// Which key, button, stick and mouse movement means what: one table, from which input is read and the list on the screen is made.
// Knows no window system.
#pragma once

#include "app/input_frame.h"

#include <array>
#include <bitset>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace antumbra::app {

/// By their place on a US keyboard.
enum class Key : uint8_t {
    W,
    A,
    S,
    D,
    Q,
    E,
    C,
    F,
    H,
    P,
    V,
    LeftShift,
    Period,
    Equal,
    Minus,
    Up,
    Down,
    Left,
    Right,
    PageUp,
    PageDown,
    F1,
    F12,
    Escape,
    None,
};
inline constexpr size_t kKeyCount = static_cast<size_t>(Key::None);

/// As on an Xbox gamepad; others by their place.
enum class PadButton : uint8_t { A, B, X, Y, LeftBumper, RightBumper, Back, Start, LeftThumb, RightThumb, Up, Right, Down, Left, None };
inline constexpr size_t kPadButtonCount = static_cast<size_t>(PadButton::None);

/// Sticks are positive to the right and up.
enum class PadAxis : uint8_t { LeftX, LeftY, RightX, RightY, None };
inline constexpr size_t kPadAxisCount = static_cast<size_t>(PadAxis::None);

/// What can be held, and how strongly.
enum class Axis : uint8_t { Right, Ahead, Run, OrbitRight, OrbitUp, Closer, LightLeft };
inline constexpr size_t kAxisCount = 7;

/// A line of the table: it asks for `action` once when pressed, or where `isHeld` adds `amount` to `axis` as long as it is held.
struct Control
{
    std::string_view what;
    bool isHeld = false;
    Axis axis = Axis::Right;
    float amount = 0;
    Action action = Action::Wave;
    Key key = Key::None;
    std::string_view keyName;
    PadButton button = PadButton::None;
    PadAxis stick = PadAxis::None;
    std::string_view padName;
};

std::span<const Control> controls();

/// The table for people: "walk", "W A S D, left stick". Lines of one meaning are joined.
struct KeyLine
{
    std::string what;
    std::string keys;
};
std::vector<KeyLine> keyLines();

/// What hands do to keyboard, mouse and gamepad: held now, and happened since the last look.
struct HandState
{
    std::bitset<kKeyCount> keysHeld;
    std::bitset<kKeyCount> keysPressed;
    std::bitset<kPadButtonCount> buttonsHeld;
    std::bitset<kPadButtonCount> buttonsPressed;
    std::array<float, kPadAxisCount> sticks{}; // -1 to 1
    vec2 drag{0};                              // pixels with the left button held, to the right and up
    float wheel = 0;                           // notches away from the person
};

} // namespace antumbra::app
