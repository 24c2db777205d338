#include "gpu/bindless.h"

#include "base/check.h"

#include <array>

namespace antumbra::gpu {

namespace {

constexpr uint32_t kPushBytes = 128; // what Vulkan guarantees

VkSampler makeSampler(VkDevice device, VkFilter filter, VkSamplerAddressMode u, VkSamplerAddressMode v)
{
    const VkSamplerCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter,
        .minFilter = filter,
        .mipmapMode = filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = u,
        .addressModeV = v,
        .addressModeW = v,
        .maxLod = VK_LOD_CLAMP_NONE,
    };
    VkSampler sampler = VK_NULL_HANDLE;
    require(vkCreateSampler(device, &info, nullptr, &sampler), "vkCreateSampler");
    return sampler;
}

std::vector<uint32_t> allSlots()
{
    std::vector<uint32_t> slots(kSlotCount);
    for (uint32_t i = 0; i < kSlotCount; ++i)
        slots[i] = kSlotCount - 1 - i;
    return slots;
}

} // namespace

Bindless::Bindless(VkDevice device) : device_(device), freeSampled_(allSlots()), freeStorage_(allSlots()), freeBuffers_(allSlots())
{
    constexpr auto clamp = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    constexpr auto repeat = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    samplers_[0] = makeSampler(device, VK_FILTER_LINEAR, clamp, clamp);
    samplers_[1] = makeSampler(device, VK_FILTER_LINEAR, repeat, repeat);
    samplers_[2] = makeSampler(device, VK_FILTER_NEAREST, clamp, clamp);
    samplers_[3] = makeSampler(device, VK_FILTER_LINEAR, repeat, clamp);

    const std::array<VkDescriptorSetLayoutBinding, 4> bindings{{
        {0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, kSlotCount, VK_SHADER_STAGE_ALL, nullptr},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kSlotCount, VK_SHADER_STAGE_ALL, nullptr},
        {2, VK_DESCRIPTOR_TYPE_SAMPLER, 4, VK_SHADER_STAGE_ALL, samplers_},
        {3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSlotCount, VK_SHADER_STAGE_ALL, nullptr},
    }};
    constexpr VkDescriptorBindingFlags slotFlags = VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT | VK_DESCRIPTOR_BINDING_UPDATE_AFTER_BIND_BIT |
                                                   VK_DESCRIPTOR_BINDING_UPDATE_UNUSED_WHILE_PENDING_BIT;
    const std::array<VkDescriptorBindingFlags, 4> flags{slotFlags, slotFlags, 0, slotFlags};
    const VkDescriptorSetLayoutBindingFlagsCreateInfo flagsInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO,
                                                                .bindingCount = static_cast<uint32_t>(flags.size()),
                                                                .pBindingFlags = flags.data()};
    const VkDescriptorSetLayoutCreateInfo setInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  .pNext = &flagsInfo,
                                                  .flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_UPDATE_AFTER_BIND_POOL_BIT,
                                                  .bindingCount = static_cast<uint32_t>(bindings.size()),
                                                  .pBindings = bindings.data()};
    require(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout_), "vkCreateDescriptorSetLayout");

    const std::array<VkDescriptorPoolSize, 4> sizes{{{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, kSlotCount},
                                                     {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kSlotCount},
                                                     {VK_DESCRIPTOR_TYPE_SAMPLER, 4},
                                                     {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSlotCount}}};
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .flags = VK_DESCRIPTOR_POOL_CREATE_UPDATE_AFTER_BIND_BIT,
                                              .maxSets = 1,
                                              .poolSizeCount = static_cast<uint32_t>(sizes.size()),
                                              .pPoolSizes = sizes.data()};
    require(vkCreateDescriptorPool(device, &poolInfo, nullptr, &pool_), "vkCreateDescriptorPool");
    const VkDescriptorSetAllocateInfo setAllocation{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                    .descriptorPool = pool_,
                                                    .descriptorSetCount = 1,
                                                    .pSetLayouts = &setLayout_};
    require(vkAllocateDescriptorSets(device, &setAllocation, &set_), "vkAllocateDescriptorSets");

    const VkPushConstantRange push{VK_SHADER_STAGE_ALL, 0, kPushBytes};
    const VkPipelineLayoutCreateInfo layoutInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                .setLayoutCount = 1,
                                                .pSetLayouts = &setLayout_,
                                                .pushConstantRangeCount = 1,
                                                .pPushConstantRanges = &push};
    require(vkCreatePipelineLayout(device, &layoutInfo, nullptr, &layout_), "vkCreatePipelineLayout");
}

Bindless::~Bindless()
{
    vkDestroyPipelineLayout(device_, layout_, nullptr);
    vkDestroyDescriptorPool(device_, pool_, nullptr);
    vkDestroyDescriptorSetLayout(device_, setLayout_, nullptr);
    for (const VkSampler sampler : samplers_)
        vkDestroySampler(device_, sampler, nullptr);
}

uint32_t Bindless::add(std::vector<uint32_t>& freed, VkWriteDescriptorSet write)
{
    check(!freed.empty(), "a free descriptor slot");
    const uint32_t slot = freed.back();
    freed.pop_back();
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstArrayElement = slot;
    write.descriptorCount = 1;
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
    return slot;
}

uint32_t Bindless::addSampled(VkImageView view)
{
    const VkDescriptorImageInfo image{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL};
    return add(freeSampled_, {.dstBinding = static_cast<uint32_t>(Binding::SampledImages),
                              .descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                              .pImageInfo = &image});
}

uint32_t Bindless::addStorage(VkImageView view)
{
    const VkDescriptorImageInfo image{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
    return add(freeStorage_, {.dstBinding = static_cast<uint32_t>(Binding::StorageImages),
                              .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                              .pImageInfo = &image});
}

uint32_t Bindless::addBuffer(VkBuffer buffer)
{
    const VkDescriptorBufferInfo whole{buffer, 0, VK_WHOLE_SIZE};
    return add(freeBuffers_, {.dstBinding = static_cast<uint32_t>(Binding::Buffers),
                              .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                              .pBufferInfo = &whole});
}

void Bindless::bind(VkCommandBuffer commands) const
{
    for (const VkPipelineBindPoint point : {VK_PIPELINE_BIND_POINT_COMPUTE, VK_PIPELINE_BIND_POINT_GRAPHICS})
        vkCmdBindDescriptorSets(commands, point, layout_, 0, 1, &set_, 0, nullptr);
}

} // namespace antumbra::gpu
