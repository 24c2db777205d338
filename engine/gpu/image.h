// Two-dimensional images with their view and their slots in the bindless set.
#pragma once

#include "base/math.h"
#include "gpu/buffer.h"

namespace antumbra::gpu {

struct ImageInfo
{
    Format format = Format::Undefined;
    uvec2 extent{1};
    uint32_t mipLevels = 1;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT;

    friend bool operator==(const ImageInfo&, const ImageInfo&) = default;
};

class Image
{
public:
    Image() = default;
    /// With memory of its own.
    Image(Device& device, std::string_view label, const ImageInfo& info);
    /// In memory that somebody else holds for longer, at `offset` bytes; for aliasing.
    Image(Device& device, std::string_view label, const ImageInfo& info, const Allocation& within, VkDeviceSize offset);
    /// A view of an image that somebody else owns, such as a swapchain, and that outlives it.
    Image(Device& device, std::string_view label, const ImageInfo& info, VkImage borrowed);
    ~Image();
    Image(Image&& other) noexcept { swap(other); }
    Image& operator=(Image&& other) noexcept
    {
        swap(other);
        return *this;
    }

    [[nodiscard]] VkImage handle() const { return image_; }
    [[nodiscard]] VkImageView view() const { return view_; }
    [[nodiscard]] const ImageInfo& info() const { return info_; }
    [[nodiscard]] VkImageAspectFlags aspect() const;
    [[nodiscard]] uint32_t sampledSlot() const { return sampledSlot_; }
    [[nodiscard]] uint32_t storageSlot() const { return storageSlot_; }
    explicit operator bool() const { return image_ != VK_NULL_HANDLE; }

    /// What memory such an image asks for.
    static VkMemoryRequirements requirements(Device& device, const ImageInfo& info);

private:
    void createView(std::string_view label);
    void swap(Image& other) noexcept;

    Device* device_ = nullptr;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    ImageInfo info_{};
    bool isBorrowed_ = false;
    Allocation allocation_{};
    uint32_t sampledSlot_ = kNoSlot;
    uint32_t storageSlot_ = kNoSlot;
};

struct MipRange
{
    uint32_t first = 0;
    uint32_t count = 1;
};

/// A colour image's barrier between everything before and everything after, for what no frame graph orders.
void transition(VkCommandBuffer commands, VkImage image, MipRange mips, VkImageLayout from, VkImageLayout to);

/// A sampled image filled with `texels` (tightly packed rows of the first level) and box-filtered mips; waits. For loading.
Image uploadedImage(Device& device, std::string_view label, const ImageInfo& info, std::span<const std::byte> texels);

} // namespace antumbra::gpu
