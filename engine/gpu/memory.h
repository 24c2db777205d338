// Device memory in blocks, handed out in ranges. Steady frames ask for nothing; the counters prove it.
#pragma once

#include "gpu/vulkan.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace antumbra::gpu {

enum class MemoryKind {
    Device,   // fastest for the device; mapped only where all memory is
    Upload,   // written by the host each frame, read by the device
    Readback, // written by the device, read by the host
};

struct Allocation
{
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr; // null where the host cannot see it
    uint32_t block = 0;
};

struct MemoryStats
{
    uint64_t reservedBytes = 0;   // held from the driver
    uint64_t usedBytes = 0;       // handed out
    uint64_t allocationsEver = 0; // ranges handed out since the start
    uint64_t blocksEver = 0;      // blocks taken from the driver since the start
};

/// Best fit within blocks of 64 MiB; a larger request gets a block of its own. Images and buffers never share a block,
/// which meets bufferImageGranularity.
class Memory
{
public:
    Memory(VkPhysicalDevice physical, VkDevice device);
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    Allocation allocate(const VkMemoryRequirements& needs, MemoryKind kind, bool forImage);
    void free(const Allocation& allocation);
    [[nodiscard]] const MemoryStats& stats() const { return stats_; }

private:
    struct Range
    {
        VkDeviceSize offset;
        VkDeviceSize size;
    };
    struct Block
    {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize size = 0;
        std::byte* mapped = nullptr;
        uint32_t type = 0;
        bool forImages = false;
        std::vector<Range> holes; // by offset, never touching
    };

    uint32_t typeFor(uint32_t allowed, MemoryKind kind) const;
    uint32_t addBlock(uint32_t type, bool forImages, VkDeviceSize size);

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::vector<Block> blocks_;
    MemoryStats stats_;
};

} // namespace antumbra::gpu
