#include "gpu/memory.h"

#include "base/check.h"
#include "base/error.h"

#include <algorithm>
#include <initializer_list>
#include <optional>

namespace antumbra::gpu {

namespace {

constexpr VkDeviceSize kBlockBytes = VkDeviceSize{64} << 20;

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) { return (value + alignment - 1) / alignment * alignment; }

} // namespace

Memory::Memory(VkPhysicalDevice physical, VkDevice device) : device_(device)
{
    vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

Memory::~Memory()
{
    for (const Block& block : blocks_)
        vkFreeMemory(device_, block.memory, nullptr);
}

uint32_t Memory::typeFor(uint32_t allowed, MemoryKind kind) const
{
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags seen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags cached = seen | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    const auto first = [&](std::initializer_list<VkMemoryPropertyFlags> wishes) -> std::optional<uint32_t> {
        for (const VkMemoryPropertyFlags wish : wishes)
            for (uint32_t type = 0; type < properties_.memoryTypeCount; ++type)
                if ((allowed >> type & 1u) != 0 && (properties_.memoryTypes[type].propertyFlags & wish) == wish)
                    return type;
        return std::nullopt;
    };
    const auto type = kind == MemoryKind::Device   ? first({local, 0})
                      : kind == MemoryKind::Upload ? first({local | seen, seen})
                                                   : first({cached, seen});
    if (!type)
        throw Error("no memory type fits", "device memory", ExitCode::NoDevice);
    return *type;
}

uint32_t Memory::addBlock(uint32_t type, bool forImages, VkDeviceSize size)
{
    VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo info{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .pNext = &flags, .allocationSize = size, .memoryTypeIndex = type};
    Block block{.size = size, .type = type, .forImages = forImages, .holes = {{0, size}}};
    require(vkAllocateMemory(device_, &info, nullptr, &block.memory), "vkAllocateMemory");
    if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* mapped = nullptr;
        require(vkMapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
        block.mapped = static_cast<std::byte*>(mapped);
    }
    ++stats_.blocksEver;
    stats_.reservedBytes += size;

    const auto freed = std::ranges::find(blocks_, VkDeviceMemory{VK_NULL_HANDLE}, &Block::memory);
    if (freed != blocks_.end()) {
        *freed = std::move(block);
        return static_cast<uint32_t>(freed - blocks_.begin());
    }
    blocks_.push_back(std::move(block));
    return static_cast<uint32_t>(blocks_.size() - 1);
}

Allocation Memory::allocate(const VkMemoryRequirements& needs, MemoryKind kind, bool forImage)
{
    const uint32_t type = typeFor(needs.memoryTypeBits, kind);
    struct Fit
    {
        uint32_t block;
        size_t hole;
        VkDeviceSize left;
    };
    std::optional<Fit> best;
    for (uint32_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        if (block.memory == VK_NULL_HANDLE || block.type != type || block.forImages != forImage)
            continue;
        for (size_t h = 0; h < block.holes.size(); ++h) {
            const Range& hole = block.holes[h];
            const VkDeviceSize end = alignUp(hole.offset, needs.alignment) + needs.size;
            if (end <= hole.offset + hole.size && (!best || hole.size - needs.size < best->left))
                best = Fit{b, h, hole.size - needs.size};
        }
    }
    if (!best)
        best = Fit{addBlock(type, forImage, std::max(needs.size, kBlockBytes)), 0, 0};

    Block& block = blocks_[best->block];
    const Range hole = block.holes[best->hole];
    const VkDeviceSize offset = alignUp(hole.offset, needs.alignment);
    const VkDeviceSize end = offset + needs.size;
    block.holes.erase(block.holes.begin() + static_cast<std::ptrdiff_t>(best->hole));
    if (end < hole.offset + hole.size)
        block.holes.insert(block.holes.begin() + static_cast<std::ptrdiff_t>(best->hole), {end, hole.offset + hole.size - end});
    if (hole.offset < offset)
        block.holes.insert(block.holes.begin() + static_cast<std::ptrdiff_t>(best->hole), {hole.offset, offset - hole.offset});

    ++stats_.allocationsEver;
    stats_.usedBytes += needs.size;
    return {block.memory, offset, needs.size, block.mapped != nullptr ? block.mapped + offset : nullptr, best->block};
}

void Memory::free(const Allocation& allocation)
{
    if (allocation.memory == VK_NULL_HANDLE)
        return;
    Block& block = blocks_[allocation.block];
    check(block.memory == allocation.memory, "an allocation of this memory");
    auto next = std::ranges::lower_bound(block.holes, allocation.offset, {}, &Range::offset);
    next = block.holes.insert(next, {allocation.offset, allocation.size});
    if (const auto after = next + 1; after != block.holes.end() && next->offset + next->size == after->offset) {
        next->size += after->size;
        block.holes.erase(after);
    }
    if (next != block.holes.begin()) {
        const auto before = next - 1;
        if (before->offset + before->size == next->offset) {
            before->size += next->size;
            block.holes.erase(next);
        }
    }
    stats_.usedBytes -= allocation.size;

    const bool isEmpty = block.holes.size() == 1 && block.holes[0].size == block.size;
    if (isEmpty && block.size > kBlockBytes) {
        vkFreeMemory(device_, block.memory, nullptr);
        stats_.reservedBytes -= block.size;
        block = {};
    }
}

} // namespace antumbra::gpu
