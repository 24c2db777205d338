#include "gpu/buffer.h"

#include "base/check.h"

#include <cstring>
#include <utility>

namespace antumbra::gpu {

Buffer::Buffer(Device& device, std::string_view label, size_t bytes, MemoryKind kind) : device_(&device), bytes_(bytes)
{
    check(bytes > 0, "a buffer of at least one byte");
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    if (device.info().rayQuery)
        usage |=
            VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR;
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
    require(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
    // Acceleration structures and their scratch memory may start anywhere in a buffer that is aligned to 256.
    needs.alignment = std::max<VkDeviceSize>(needs.alignment, 256);
    allocation_ = device.memory().allocate(needs, kind, false);
    require(vkBindBufferMemory(device.handle(), buffer_, allocation_.memory, allocation_.offset), "vkBindBufferMemory");
    const VkBufferDeviceAddressInfo address{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, .buffer = buffer_};
    address_ = vkGetBufferDeviceAddress(device.handle(), &address);
    device.name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer_), label);
}

Buffer::~Buffer()
{
    if (device_ != nullptr)
        device_->retire({VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer_), allocation_, kNoSlot, kNoSlot, slot_});
}

void Buffer::swap(Buffer& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(buffer_, other.buffer_);
    std::swap(allocation_, other.allocation_);
    std::swap(address_, other.address_);
    std::swap(bytes_, other.bytes_);
    std::swap(slot_, other.slot_);
}

uint32_t Buffer::slot() const
{
    if (slot_ == kNoSlot)
        slot_ = device_->bindless().addBuffer(buffer_);
    return slot_;
}

void upload(Device& device, const Buffer& target, std::span<const std::byte> bytes, size_t offset)
{
    if (bytes.empty())
        return;
    check(offset + bytes.size() <= target.bytes(), "an upload that fits its buffer");
    if (target.mapped() != nullptr) {
        std::memcpy(target.mapped() + offset, bytes.data(), bytes.size());
        return;
    }
    const Buffer staging(device, "staging", bytes.size(), MemoryKind::Upload);
    std::memcpy(staging.mapped(), bytes.data(), bytes.size());
    device.submitNow([&](VkCommandBuffer commands) {
        const VkBufferCopy region{0, offset, bytes.size()};
        vkCmdCopyBuffer(commands, staging.handle(), target.handle(), 1, &region);
    });
}

} // namespace antumbra::gpu
