// A window and what hands do in it, through GLFW. Draws nothing and decides nothing; gpu/swapchain.h shows pictures in it.
#pragma once

#include "app/controls.h"
#include "base/math.h"

#include <memory>
#include <span>
#include <string>

struct GLFWwindow;

namespace antumbra::app {

/// In pixels from the top left corner of the picture.
struct Pointer
{
    vec2 position{-1};
    std::array<bool, 3> isHeld{}; // left, right, middle
    float wheel = 0;              // notches since the last look
};

class Window
{
public:
    /// Nothing where there is no display. Throws Error where there is one, but no Vulkan for it.
    static std::unique_ptr<Window> open(uvec2 size, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] GLFWwindow* handle() const { return window_; }
    /// What it asks of a Vulkan instance.
    [[nodiscard]] static std::span<const char* const> vulkanExtensions();
    [[nodiscard]] bool wantsToClose() const;
    void setTitle(const std::string& title);

    /// Takes what happened since the last call, without waiting.
    void poll();
    [[nodiscard]] const HandState& hands() const { return hands_; }
    [[nodiscard]] const Pointer& pointer() const { return pointer_; }

private:
    explicit Window(GLFWwindow* window);

    void listen();
    void readPointer();
    void readGamepad();

    GLFWwindow* window_;
    HandState hands_;
    Pointer pointer_;
};

} // namespace antumbra::app
