// Vulkan's entry points, loaded by volk, and the one way results are judged.
#pragma once

#define VK_NO_PROTOTYPES
#include <volk.h>

#include "gpu/format.h"

#include <string_view>

namespace antumbra::gpu {

/// Throws Error naming `call` (exit 3) unless `result` is a success; VK_SUBOPTIMAL_KHR and the like pass.
void require(VkResult result, std::string_view call);

VkFormat vulkanFormat(Format format);

} // namespace antumbra::gpu
