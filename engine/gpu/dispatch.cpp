#include "gpu/dispatch.h"

namespace antumbra::gpu {

void dispatchNow(Device& device, const Pipeline& pipeline, std::span<const std::byte> push, uint32_t threads, uint32_t groupSize)
{
    check(push.size() <= 128, "push constants of at most 128 bytes");
    const VkCommandBuffer commands = device.beginFrame();
    vkCmdBindPipeline(commands, pipeline.bindPoint(), pipeline.handle());
    vkCmdPushConstants(commands, device.bindless().layout(), VK_SHADER_STAGE_ALL, 0, static_cast<uint32_t>(push.size()), push.data());
    vkCmdDispatch(commands, (threads + groupSize - 1) / groupSize, 1, 1);
    const VkMemoryBarrier2 toHost{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                  .srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                  .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                  .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &toHost};
    vkCmdPipelineBarrier2(commands, &dependency);
    device.endFrame(VK_NULL_HANDLE, VK_NULL_HANDLE);
    device.waitIdle();
}

} // namespace antumbra::gpu
