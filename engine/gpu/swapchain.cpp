#include "gpu/swapchain.h"

#include "base/check.h"
#include "base/error.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <limits>

namespace antumbra::gpu {

namespace {

constexpr uint64_t kNoTimeout = std::numeric_limits<uint64_t>::max();

bool isOutdated(VkResult result) { return result == VK_ERROR_OUT_OF_DATE_KHR; }

VkSurfaceFormatKHR chooseFormat(VkPhysicalDevice physical, VkSurfaceKHR surface)
{
    uint32_t count = 0;
    require(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, nullptr), "vkGetPhysicalDeviceSurfaceFormatsKHR");
    std::vector<VkSurfaceFormatKHR> formats(count);
    require(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, formats.data()), "vkGetPhysicalDeviceSurfaceFormatsKHR");
    const auto fits = [](const VkSurfaceFormatKHR& each) {
        return (each.format == VK_FORMAT_B8G8R8A8_UNORM || each.format == VK_FORMAT_R8G8B8A8_UNORM) &&
               each.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    };
    const auto found = std::ranges::find_if(formats, fits);
    if (found == formats.end())
        throw Error("the window takes no 8-bit UNORM pictures", "swapchain", ExitCode::NoDevice);
    return *found;
}

VkSurfaceCapabilitiesKHR capabilitiesOf(VkPhysicalDevice physical, VkSurfaceKHR surface)
{
    VkSurfaceCapabilitiesKHR capabilities{};
    require(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(physical, surface, &capabilities), "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    return capabilities;
}

uint32_t imageCountFor(const VkSurfaceCapabilitiesKHR& capabilities)
{
    const uint32_t wanted = capabilities.minImageCount + 1;
    // A greatest count of 0 means that there is none.
    return capabilities.maxImageCount == 0 ? wanted : std::min(wanted, capabilities.maxImageCount);
}

VkCompositeAlphaFlagBitsKHR alphaFor(const VkSurfaceCapabilitiesKHR& capabilities)
{
    return (capabilities.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0 ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                                           : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

VkSemaphore makeSemaphore(Device& device)
{
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    require(vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore), "vkCreateSemaphore");
    return semaphore;
}

} // namespace

Swapchain::Swapchain(Device& device, GLFWwindow* window) : device_(device), window_(window)
{
    require(glfwCreateWindowSurface(device.instance(), window, nullptr, &surface_), "glfwCreateWindowSurface");
    VkBool32 presents = VK_FALSE;
    require(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical(), device.queueFamily(), surface_, &presents),
            "vkGetPhysicalDeviceSurfaceSupportKHR");
    if (presents == VK_FALSE)
        throw Error("the device cannot show pictures in this window", device.info().name, ExitCode::NoDevice);
    format_ = chooseFormat(device.physical(), surface_);
    std::ranges::generate(available_, [&] { return makeSemaphore(device); });
}

Swapchain::~Swapchain()
{
    device_.waitIdle();
    retireImages();
    for (const VkSemaphore semaphore : available_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

uvec2 Swapchain::windowExtent() const
{
    // Not every window system makes a window that nobody sees smaller.
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE || glfwGetWindowAttrib(window_, GLFW_VISIBLE) == GLFW_FALSE)
        return uvec2(0);
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {width, height};
}

void Swapchain::retireImages()
{
    images_.clear();
    for (const VkSemaphore semaphore : finished_)
        vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    finished_.clear();
}

void Swapchain::recreate(uvec2 extent)
{
    device_.waitIdle();
    retireImages();
    const VkSurfaceCapabilitiesKHR capabilities = capabilitiesOf(device_.physical(), surface_);
    const uvec2 imageExtent = glm::clamp(extent, uvec2(capabilities.minImageExtent.width, capabilities.minImageExtent.height),
                                         uvec2(capabilities.maxImageExtent.width, capabilities.maxImageExtent.height));
    const VkSwapchainKHR before = swapchain_;
    const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                        .surface = surface_,
                                        .minImageCount = imageCountFor(capabilities),
                                        .imageFormat = format_.format,
                                        .imageColorSpace = format_.colorSpace,
                                        .imageExtent = {imageExtent.x, imageExtent.y},
                                        .imageArrayLayers = 1,
                                        .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                        .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                        .preTransform = capabilities.currentTransform,
                                        .compositeAlpha = alphaFor(capabilities),
                                        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
                                        .clipped = VK_TRUE,
                                        .oldSwapchain = before};
    require(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &swapchain_), "vkCreateSwapchainKHR");
    vkDestroySwapchainKHR(device_.handle(), before, nullptr);

    uint32_t count = 0;
    require(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr), "vkGetSwapchainImagesKHR");
    std::vector<VkImage> handles(count);
    require(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, handles.data()), "vkGetSwapchainImagesKHR");
    const ImageInfo imageInfo{.format = format_.format == VK_FORMAT_B8G8R8A8_UNORM ? Format::Bgra8Unorm : Format::Rgba8Unorm,
                              .extent = imageExtent,
                              .usage = info.imageUsage};
    for (const VkImage handle : handles) {
        images_.emplace_back(device_, "window image", imageInfo, handle);
        finished_.push_back(makeSemaphore(device_));
    }
    madeFor_ = extent;
    isStale_ = false;
}

std::optional<WindowImage> Swapchain::acquire()
{
    // A window that is resized while we look may outdate the new images too; the next call then tries again.
    for (int attempt = 0; attempt < 2; ++attempt) {
        const uvec2 extent = windowExtent();
        if (extent.x == 0 || extent.y == 0)
            return std::nullopt;
        if (swapchain_ == VK_NULL_HANDLE || isStale_ || extent != madeFor_)
            recreate(extent);
        const VkSemaphore available = available_[nextAvailable_];
        const VkResult result = vkAcquireNextImageKHR(device_.handle(), swapchain_, kNoTimeout, available, VK_NULL_HANDLE, &acquired_);
        if (isOutdated(result)) {
            isStale_ = true;
            continue;
        }
        require(result, "vkAcquireNextImageKHR");
        // What is suboptimal can still be shown once.
        isStale_ = result == VK_SUBOPTIMAL_KHR;
        nextAvailable_ = (nextAvailable_ + 1) % kSemaphores;
        return WindowImage{&images_[acquired_], available, finished_[acquired_]};
    }
    return std::nullopt;
}

void Swapchain::present()
{
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &finished_[acquired_],
                                .swapchainCount = 1,
                                .pSwapchains = &swapchain_,
                                .pImageIndices = &acquired_};
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (isOutdated(result) || result == VK_SUBOPTIMAL_KHR)
        isStale_ = true;
    else
        require(result, "vkQueuePresentKHR");
}

void Swapchain::showColor(vec3 color)
{
    const std::optional<WindowImage> target = acquire();
    if (!target)
        return;
    const VkCommandBuffer commands = device_.beginFrame();
    const VkImage image = target->image->handle();
    transition(commands, image, {0, 1}, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkClearColorValue value{{color.x, color.y, color.z, 1}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &all);
    transition(commands, image, {0, 1}, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    device_.endFrame(target->available, target->finished);
    present();
}

} // namespace antumbra::gpu
