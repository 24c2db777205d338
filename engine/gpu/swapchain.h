// The pictures a window shows, one after the other: acquired, written by the caller, presented. Makes no window and draws nothing.
// Formats are UNORM: what is written is encoded for the screen already.
#pragma once

#include "gpu/image.h"

#include <array>
#include <optional>

struct GLFWwindow;

namespace antumbra::gpu {

/// An image to write. The frame that writes it waits for `available` and signals `finished`.
struct WindowImage
{
    const Image* image = nullptr;
    VkSemaphore available = VK_NULL_HANDLE;
    VkSemaphore finished = VK_NULL_HANDLE;
};

class Swapchain
{
public:
    /// `device` must have been made with the window's extensions. Throws Error where it cannot show anything in such a window.
    Swapchain(Device& device, GLFWwindow* window);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// The window's size in pixels; 0 while it is minimised or hidden.
    [[nodiscard]] uvec2 windowExtent() const;
    /// Nothing while the window's extent is 0. Follows the window's size, which waits for the device. At most one image is acquired.
    std::optional<WindowImage> acquire();
    /// Hands the acquired image to the screen once its frame has signalled.
    void present();
    /// Shows one colour at once (sRGB-encoded): the screen while there is no picture yet.
    void showColor(vec3 color);

private:
    // One more than frames in flight: the fence of the frame that last waited for a semaphore has then been waited for.
    static constexpr uint32_t kSemaphores = kFramesInFlight + 1;

    void recreate(uvec2 extent);
    void retireImages();

    Device& device_;
    GLFWwindow* window_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    uvec2 madeFor_{0};     // the window's extent then
    bool isStale_ = false; // no longer fits the window
    std::vector<Image> images_;
    std::vector<VkSemaphore> finished_; // one an image: presentation has no fence to tell when it is done with one
    std::array<VkSemaphore, kSemaphores> available_{};
    uint32_t nextAvailable_ = 0;
    uint32_t acquired_ = 0;
};

} // namespace antumbra::gpu
