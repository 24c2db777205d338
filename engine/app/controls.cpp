#include "app/controls.h"

namespace antumbra::app {

namespace {

constexpr Control held(std::string_view what, Axis axis, float amount, Key key, std::string_view keyName,
                       PadButton button = PadButton::None, std::string_view padName = "")
{
    return {
        .what = what, .isHeld = true, .axis = axis, .amount = amount, .key = key, .keyName = keyName, .button = button, .padName = padName};
}

constexpr Control stick(std::string_view what, Axis axis, PadAxis stick, std::string_view padName)
{
    return {.what = what, .isHeld = true, .axis = axis, .amount = 1, .stick = stick, .padName = padName};
}

constexpr Control pressed(std::string_view what, Action action, Key key, std::string_view keyName, PadButton button = PadButton::None,
                          std::string_view padName = "")
{
    return {.what = what, .action = action, .key = key, .keyName = keyName, .button = button, .padName = padName};
}

constexpr Control kControls[] = {
    held("walk", Axis::Ahead, 1, Key::W, "W"),
    held("walk", Axis::Right, -1, Key::A, "A"),
    held("walk", Axis::Ahead, -1, Key::S, "S"),
    held("walk", Axis::Right, 1, Key::D, "D"),
    stick("walk", Axis::Right, PadAxis::LeftX, "left stick"),
    stick("walk", Axis::Ahead, PadAxis::LeftY, "left stick"),
    held("run", Axis::Run, 1, Key::LeftShift, "Shift", PadButton::B, "B"),
    pressed("wave", Action::Wave, Key::F, "F", PadButton::X, "X"),
    held("look around", Axis::OrbitRight, -1, Key::Left, "arrows or drag"),
    held("look around", Axis::OrbitRight, 1, Key::Right, "arrows or drag"),
    held("look around", Axis::OrbitUp, 1, Key::Up, "arrows or drag"),
    held("look around", Axis::OrbitUp, -1, Key::Down, "arrows or drag"),
    stick("look around", Axis::OrbitRight, PadAxis::RightX, "right stick"),
    stick("look around", Axis::OrbitUp, PadAxis::RightY, "right stick"),
    held("zoom", Axis::Closer, 1, Key::PageUp, "Page Up", PadButton::Up, "pad up"),
    held("zoom", Axis::Closer, -1, Key::PageDown, "Page Down or wheel", PadButton::Down, "pad down"),
    pressed("follow or orbit", Action::ChangeCamera, Key::C, "C", PadButton::RightThumb, "right thumb"),
    held("turn the light", Axis::LightLeft, 1, Key::Q, "Q", PadButton::Left, "pad left"),
    held("turn the light", Axis::LightLeft, -1, Key::E, "E", PadButton::Right, "pad right"),
    pressed("pause", Action::Pause, Key::P, "P", PadButton::Start, "Start"),
    pressed("single step", Action::SingleStep, Key::Period, ".", PadButton::A, "A"),
    pressed("slower", Action::Slower, Key::Minus, "-", PadButton::LeftBumper, "left bumper"),
    pressed("faster", Action::Faster, Key::Equal, "+", PadButton::RightBumper, "right bumper"),
    pressed("overlay", Action::ToggleOverlay, Key::F1, "F1", PadButton::Back, "Back"),
    pressed("keys", Action::ToggleKeys, Key::H, "H", PadButton::LeftThumb, "left thumb"),
    pressed("next view", Action::NextView, Key::V, "V", PadButton::Y, "Y"),
    pressed("screenshot", Action::Screenshot, Key::F12, "F12"),
    pressed("quit", Action::Quit, Key::Escape, "Esc"),
};

void append(std::string& keys, std::string_view name, std::string_view separator)
{
    if (name.empty() || keys.find(name) != std::string::npos)
        return;
    if (!keys.empty())
        keys += separator;
    keys += name;
}

} // namespace

std::span<const Control> controls() { return kControls; }

std::vector<KeyLine> keyLines()
{
    std::vector<KeyLine> lines;
    for (const Control& control : kControls)
        if (lines.empty() || lines.back().what != control.what)
            lines.push_back({std::string(control.what), ""});
    for (KeyLine& line : lines) {
        std::string pad;
        for (const Control& control : kControls)
            if (control.what == line.what) {
                append(line.keys, control.keyName, " ");
                append(pad, control.padName, " ");
            }
        append(line.keys, pad, ", ");
    }
    return lines;
}

} // namespace antumbra::app
