// One descriptor set for everything: shaders find images by slot numbers that travel in push constants, buffers by address. Buffers that
// all threads read alike have slots too: CPU devices read those once a subgroup, and gather what comes by address.
#pragma once

#include "gpu/vulkan.h"

#include <cstdint>
#include <vector>

namespace antumbra::gpu {

/// The bindings of set 0; shaders/lib/bindless.glsl declares the same.
enum class Binding : uint32_t { SampledImages = 0, StorageImages = 1, Samplers = 2, Buffers = 3 };
enum class SamplerSlot : uint32_t { LinearClamp = 0, LinearRepeat = 1, NearestClamp = 2, LinearWrapU = 3 };

inline constexpr uint32_t kSlotCount = 4096;
inline constexpr uint32_t kNoSlot = ~0u;

class Bindless
{
public:
    explicit Bindless(VkDevice device);
    ~Bindless();
    Bindless(const Bindless&) = delete;
    Bindless& operator=(const Bindless&) = delete;

    /// Slots stay the image's until given back; the caller gives one back only when no frame in flight can read it.
    uint32_t addSampled(VkImageView view);
    uint32_t addStorage(VkImageView view);
    uint32_t addBuffer(VkBuffer buffer);
    void freeSampled(uint32_t slot) { freeSampled_.push_back(slot); }
    void freeStorage(uint32_t slot) { freeStorage_.push_back(slot); }
    void freeBuffer(uint32_t slot) { freeBuffers_.push_back(slot); }

    [[nodiscard]] VkPipelineLayout layout() const { return layout_; }
    void bind(VkCommandBuffer commands) const;

private:
    uint32_t add(std::vector<uint32_t>& freed, VkWriteDescriptorSet write);

    VkDevice device_;
    VkSampler samplers_[4]{};
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    std::vector<uint32_t> freeSampled_;
    std::vector<uint32_t> freeStorage_;
    std::vector<uint32_t> freeBuffers_;
};

} // namespace antumbra::gpu
