// A range of bytes on the device, usable for anything shaders, copies and acceleration structures ask of it.
#pragma once

#include "gpu/device.h"

#include <span>

namespace antumbra::gpu {

class Buffer
{
public:
    Buffer() = default;
    Buffer(Device& device, std::string_view label, size_t bytes, MemoryKind kind = MemoryKind::Device);
    ~Buffer();
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept
    {
        swap(other);
        return *this;
    }

    [[nodiscard]] VkBuffer handle() const { return buffer_; }
    [[nodiscard]] VkDeviceAddress address() const { return address_; }
    /// In the bindless set; given at the first call.
    [[nodiscard]] uint32_t slot() const;
    [[nodiscard]] size_t bytes() const { return bytes_; }
    /// Null where the host cannot see the memory.
    [[nodiscard]] std::byte* mapped() const { return allocation_.mapped; }
    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }

private:
    void swap(Buffer& other) noexcept;

    Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    Allocation allocation_{};
    VkDeviceAddress address_ = 0;
    size_t bytes_ = 0;
    mutable uint32_t slot_ = kNoSlot;
};

/// Copies to the device and waits; for loading. `offset` in bytes.
void upload(Device& device, const Buffer& target, std::span<const std::byte> bytes, size_t offset = 0);

/// A device buffer that holds a copy of `values`.
template <class T>
Buffer uploadedBuffer(Device& device, std::string_view label, std::span<const T> values)
{
    Buffer buffer(device, label, std::max<size_t>(values.size_bytes(), 16));
    upload(device, buffer, std::as_bytes(values));
    return buffer;
}

} // namespace antumbra::gpu
