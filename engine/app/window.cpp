#include "app/window.h"

#include "base/error.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <optional>

namespace antumbra::app {

namespace {

struct KeyCode
{
    Key key;
    int code;
};

constexpr KeyCode kKeyCodes[] = {
    {Key::W, GLFW_KEY_W},
    {Key::A, GLFW_KEY_A},
    {Key::S, GLFW_KEY_S},
    {Key::D, GLFW_KEY_D},
    {Key::Q, GLFW_KEY_Q},
    {Key::E, GLFW_KEY_E},
    {Key::C, GLFW_KEY_C},
    {Key::F, GLFW_KEY_F},
    {Key::H, GLFW_KEY_H},
    {Key::P, GLFW_KEY_P},
    {Key::V, GLFW_KEY_V},
    {Key::LeftShift, GLFW_KEY_LEFT_SHIFT},
    {Key::Period, GLFW_KEY_PERIOD},
    {Key::Equal, GLFW_KEY_EQUAL},
    {Key::Minus, GLFW_KEY_MINUS},
    {Key::Up, GLFW_KEY_UP},
    {Key::Down, GLFW_KEY_DOWN},
    {Key::Left, GLFW_KEY_LEFT},
    {Key::Right, GLFW_KEY_RIGHT},
    {Key::PageUp, GLFW_KEY_PAGE_UP},
    {Key::PageDown, GLFW_KEY_PAGE_DOWN},
    {Key::F1, GLFW_KEY_F1},
    {Key::F12, GLFW_KEY_F12},
    {Key::Escape, GLFW_KEY_ESCAPE},
};
static_assert(std::size(kKeyCodes) == kKeyCount, "a code for every key");

constexpr int kPadButtonCodes[] = {
    GLFW_GAMEPAD_BUTTON_A,           GLFW_GAMEPAD_BUTTON_B,           GLFW_GAMEPAD_BUTTON_X,
    GLFW_GAMEPAD_BUTTON_Y,           GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER,
    GLFW_GAMEPAD_BUTTON_BACK,        GLFW_GAMEPAD_BUTTON_START,       GLFW_GAMEPAD_BUTTON_LEFT_THUMB,
    GLFW_GAMEPAD_BUTTON_RIGHT_THUMB, GLFW_GAMEPAD_BUTTON_DPAD_UP,     GLFW_GAMEPAD_BUTTON_DPAD_RIGHT,
    GLFW_GAMEPAD_BUTTON_DPAD_DOWN,   GLFW_GAMEPAD_BUTTON_DPAD_LEFT,
};
static_assert(std::size(kPadButtonCodes) == kPadButtonCount, "a code for every button");

std::optional<size_t> keyOf(int code)
{
    const auto* found = std::ranges::find(kKeyCodes, code, &KeyCode::code);
    return found != std::end(kKeyCodes) ? std::optional(static_cast<size_t>(found->key)) : std::nullopt;
}

std::string lastComplaint()
{
    const char* description = nullptr;
    glfwGetError(&description);
    return description != nullptr ? description : "unknown reason";
}

// All at rest where there is none, so one that is unplugged lets go of everything. Joysticks that GLFW has no mapping for are no gamepads.
GLFWgamepadstate firstGamepad()
{
    GLFWgamepadstate state{};
    for (int slot = GLFW_JOYSTICK_1; slot <= GLFW_JOYSTICK_LAST; ++slot)
        if (glfwGetGamepadState(slot, &state) == GLFW_TRUE)
            return state;
    return {};
}

Window& windowOf(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

} // namespace

std::unique_ptr<Window> Window::open(uvec2 size, const std::string& title)
{
    if (glfwInit() != GLFW_TRUE)
        return nullptr;
    if (glfwVulkanSupported() != GLFW_TRUE) {
        glfwTerminate();
        throw Error("no Vulkan for windows on this display", "window", ExitCode::NoDevice);
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    GLFWwindow* window = glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
    if (window == nullptr) {
        const std::string reason = lastComplaint();
        glfwTerminate();
        throw Error(reason, "window", ExitCode::NoDevice);
    }
    return std::unique_ptr<Window>(new Window(window));
}

Window::Window(GLFWwindow* window) : window_(window) { listen(); }

Window::~Window()
{
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::span<const char* const> Window::vulkanExtensions()
{
    uint32_t count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&count);
    return {extensions, count};
}

bool Window::wantsToClose() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void Window::listen()
{
    glfwSetWindowUserPointer(window_, this);
    // Presses are counted here and not by comparing states: one that is shorter than a picture still counts.
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int code, int, int action, int) {
        const std::optional<size_t> key = keyOf(code);
        if (!key || action == GLFW_REPEAT)
            return;
        HandState& hands = windowOf(window).hands_;
        hands.keysHeld[*key] = action == GLFW_PRESS;
        if (action == GLFW_PRESS)
            hands.keysPressed[*key] = true;
    });
    glfwSetScrollCallback(
        window_, [](GLFWwindow* window, double, double notches) { windowOf(window).pointer_.wheel += static_cast<float>(notches); });
}

void Window::poll()
{
    hands_.keysPressed.reset();
    pointer_.wheel = 0;
    glfwPollEvents();
    readPointer();
    readGamepad();
}

void Window::readPointer()
{
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    int width = 0, height = 0, pixelWidth = 0, pixelHeight = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixelWidth, &pixelHeight);
    // Where screen coordinates are not pixels, the ratio of the two sizes tells how they go together.
    const vec2 scale = vec2(pixelWidth, pixelHeight) / glm::max(vec2(width, height), vec2(1));
    const vec2 position = vec2(x, y) * scale;
    const bool wasDragging = pointer_.isHeld[0];
    for (int button = 0; button < 3; ++button)
        pointer_.isHeld[static_cast<size_t>(button)] = glfwGetMouseButton(window_, button) == GLFW_PRESS;
    const vec2 moved = position - pointer_.position;
    hands_.drag = wasDragging && pointer_.isHeld[0] ? vec2(moved.x, -moved.y) : vec2(0);
    hands_.wheel = pointer_.wheel;
    pointer_.position = position;
}

void Window::readGamepad()
{
    const GLFWgamepadstate state = firstGamepad();
    hands_.sticks = {state.axes[GLFW_GAMEPAD_AXIS_LEFT_X], -state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y], state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X],
                     -state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]};
    std::bitset<kPadButtonCount> held;
    for (size_t button = 0; button < kPadButtonCount; ++button)
        held[button] = state.buttons[kPadButtonCodes[button]] == GLFW_PRESS;
    hands_.buttonsPressed = held & ~hands_.buttonsHeld;
    hands_.buttonsHeld = held;
}

} // namespace antumbra::app
