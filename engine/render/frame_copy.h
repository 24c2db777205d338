// Values of the host for one frame of the device.
#pragma once

#include "gpu/device.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

namespace antumbra::render {

/// Copies to the frame's store; never null.
template <class T>
VkDeviceAddress frameCopy(gpu::Device& device, std::span<const T> values)
{
    const gpu::FrameBytes bytes = device.frameBytes(std::max<size_t>(values.size_bytes(), 1));
    std::memcpy(bytes.mapped, values.data(), values.size_bytes());
    return bytes.address;
}

template <class T>
VkDeviceAddress frameCopy(gpu::Device& device, const std::vector<T>& values)
{
    return frameCopy(device, std::span<const T>(values));
}

} // namespace antumbra::render
