#define VOLK_IMPLEMENTATION
#include "gpu/vulkan.h"

#include "base/error.h"

namespace antumbra::gpu {

void require(VkResult result, std::string_view call)
{
    if (result >= 0) [[likely]]
        return;
    const std::string reason = result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY ? "out of memory"
                               : result == VK_ERROR_DEVICE_LOST                                                 ? "the device was lost"
                                                                : "Vulkan error " + std::to_string(static_cast<int>(result));
    throw Error(reason, std::string(call), ExitCode::NoDevice);
}

VkFormat vulkanFormat(Format format)
{
    switch (format) {
    case Format::Undefined: return VK_FORMAT_UNDEFINED;
    case Format::R8Unorm: return VK_FORMAT_R8_UNORM;
    case Format::Rgba8Unorm: return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::Rgba8Srgb: return VK_FORMAT_R8G8B8A8_SRGB;
    case Format::Bgra8Unorm: return VK_FORMAT_B8G8R8A8_UNORM;
    case Format::Bgra8Srgb: return VK_FORMAT_B8G8R8A8_SRGB;
    case Format::R16Float: return VK_FORMAT_R16_SFLOAT;
    case Format::Rg16Float: return VK_FORMAT_R16G16_SFLOAT;
    case Format::Rgba16Float: return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::Rgba16Snorm: return VK_FORMAT_R16G16B16A16_SNORM;
    case Format::R32Float: return VK_FORMAT_R32_SFLOAT;
    case Format::Rg32Float: return VK_FORMAT_R32G32_SFLOAT;
    case Format::Rgba32Float: return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::R32Uint: return VK_FORMAT_R32_UINT;
    case Format::Rg32Uint: return VK_FORMAT_R32G32_UINT;
    case Format::Rgba32Uint: return VK_FORMAT_R32G32B32A32_UINT;
    case Format::Depth32Float: return VK_FORMAT_D32_SFLOAT;
    }
    return VK_FORMAT_UNDEFINED;
}

} // namespace antumbra::gpu
