#include "gpu/timers.h"

#include "base/check.h"

namespace antumbra::gpu {

Timers::Timers(Device& device) : device_(device)
{
    if (device.info().nanosecondsPerTick == 0.0f)
        return;
    const VkQueryPoolCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = VK_QUERY_TYPE_TIMESTAMP, .queryCount = 2 * kMostSpans};
    for (VkQueryPool& pool : pools_) {
        require(vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "vkCreateQueryPool");
        vkResetQueryPool(device.handle(), pool, 0, 2 * kMostSpans);
    }
}

Timers::~Timers()
{
    for (const VkQueryPool pool : pools_)
        if (pool != VK_NULL_HANDLE)
            device_.retire({VK_OBJECT_TYPE_QUERY_POOL, reinterpret_cast<uint64_t>(pool)});
}

void Timers::beginFrame()
{
    const uint32_t slot = device_.frameSlot();
    doneSpans_ = 0;
    if (pools_[slot] != VK_NULL_HANDLE && spans_[slot] > 0) {
        const uint32_t queries = 2 * spans_[slot];
        if (vkGetQueryPoolResults(device_.handle(), pools_[slot], 0, queries, queries * sizeof(uint64_t), ticks_, sizeof(uint64_t),
                                  VK_QUERY_RESULT_64_BIT) == VK_SUCCESS)
            doneSpans_ = spans_[slot];
        vkResetQueryPool(device_.handle(), pools_[slot], 0, queries);
    }
    spans_[slot] = 0;
}

void Timers::begin(VkCommandBuffer commands)
{
    const uint32_t slot = device_.frameSlot();
    check(spans_[slot] < kMostSpans, "fewer timed spans than the pool holds");
    if (pools_[slot] != VK_NULL_HANDLE)
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pools_[slot], 2 * spans_[slot]);
}

void Timers::end(VkCommandBuffer commands)
{
    const uint32_t slot = device_.frameSlot();
    if (pools_[slot] != VK_NULL_HANDLE)
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pools_[slot], 2 * spans_[slot] + 1);
    ++spans_[slot];
}

double Timers::between(uint32_t firstQuery, uint32_t lastQuery) const
{
    // Ticks may step back across a device's clock domains: never below zero.
    const double ticks = ticks_[lastQuery] > ticks_[firstQuery] ? static_cast<double>(ticks_[lastQuery] - ticks_[firstQuery]) : 0.0;
    return ticks * static_cast<double>(device_.info().nanosecondsPerTick) * 1e-6;
}

std::optional<double> Timers::milliseconds(uint32_t index) const
{
    if (index >= doneSpans_)
        return std::nullopt;
    return between(2 * index, 2 * index + 1);
}

std::optional<double> Timers::wholeMilliseconds() const
{
    if (doneSpans_ == 0)
        return std::nullopt;
    return between(0, 2 * doneSpans_ - 1);
}

} // namespace antumbra::gpu
