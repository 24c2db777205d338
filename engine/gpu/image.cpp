#include "gpu/image.h"

#include "base/check.h"

#include <cstring>
#include <utility>

namespace antumbra::gpu {

namespace {

VkImageCreateInfo createInfo(const ImageInfo& info)
{
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
            .imageType = VK_IMAGE_TYPE_2D,
            .format = vulkanFormat(info.format),
            .extent = {info.extent.x, info.extent.y, 1},
            .mipLevels = info.mipLevels,
            .arrayLayers = 1,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .tiling = VK_IMAGE_TILING_OPTIMAL,
            .usage = info.usage};
}

VkOffset3D levelEnd(uvec2 extent, uint32_t level)
{
    const uvec2 size = glm::max(extent >> level, uvec2(1));
    return {static_cast<int32_t>(size.x), static_cast<int32_t>(size.y), 1};
}

void fillMips(VkCommandBuffer commands, const Image& image)
{
    for (uint32_t level = 1; level < image.info().mipLevels; ++level) {
        transition(commands, image.handle(), {level - 1, 1}, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkImageBlit blit{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 0, 1},
                               .srcOffsets = {{}, levelEnd(image.info().extent, level - 1)},
                               .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1},
                               .dstOffsets = {{}, levelEnd(image.info().extent, level)}};
        vkCmdBlitImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                       1, &blit, VK_FILTER_LINEAR);
        transition(commands, image.handle(), {level - 1, 1}, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL);
    }
    transition(commands, image.handle(), {image.info().mipLevels - 1, 1}, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL);
}

} // namespace

Image::Image(Device& device, std::string_view label, const ImageInfo& info) : device_(&device), info_(info)
{
    const VkImageCreateInfo create = createInfo(info);
    require(vkCreateImage(device.handle(), &create, nullptr, &image_), "vkCreateImage");
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device.handle(), image_, &needs);
    allocation_ = device.memory().allocate(needs, MemoryKind::Device, true);
    require(vkBindImageMemory(device.handle(), image_, allocation_.memory, allocation_.offset), "vkBindImageMemory");
    createView(label);
}

Image::Image(Device& device, std::string_view label, const ImageInfo& info, const Allocation& within, VkDeviceSize offset)
    : device_(&device), info_(info)
{
    const VkImageCreateInfo create = createInfo(info);
    require(vkCreateImage(device.handle(), &create, nullptr, &image_), "vkCreateImage");
    require(vkBindImageMemory(device.handle(), image_, within.memory, within.offset + offset), "vkBindImageMemory");
    createView(label);
}

Image::Image(Device& device, std::string_view label, const ImageInfo& info, VkImage borrowed)
    : device_(&device), image_(borrowed), info_(info), isBorrowed_(true)
{
    createView(label);
}

void Image::createView(std::string_view label)
{
    const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = image_,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = vulkanFormat(info_.format),
                                     .subresourceRange = {aspect(), 0, info_.mipLevels, 0, 1}};
    require(vkCreateImageView(device_->handle(), &info, nullptr, &view_), "vkCreateImageView");
    if ((info_.usage & VK_IMAGE_USAGE_SAMPLED_BIT) != 0)
        sampledSlot_ = device_->bindless().addSampled(view_);
    if ((info_.usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0)
        storageSlot_ = device_->bindless().addStorage(view_);
    device_->name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image_), label);
}

Image::~Image()
{
    if (device_ == nullptr)
        return;
    device_->retire({VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<uint64_t>(view_), {}, sampledSlot_, storageSlot_});
    if (!isBorrowed_)
        device_->retire({VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image_), allocation_});
}

void Image::swap(Image& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(image_, other.image_);
    std::swap(view_, other.view_);
    std::swap(info_, other.info_);
    std::swap(isBorrowed_, other.isBorrowed_);
    std::swap(allocation_, other.allocation_);
    std::swap(sampledSlot_, other.sampledSlot_);
    std::swap(storageSlot_, other.storageSlot_);
}

VkImageAspectFlags Image::aspect() const
{
    return isDepth(info_.format) ? VkImageAspectFlags{VK_IMAGE_ASPECT_DEPTH_BIT} : VkImageAspectFlags{VK_IMAGE_ASPECT_COLOR_BIT};
}

VkMemoryRequirements Image::requirements(Device& device, const ImageInfo& info)
{
    const VkImageCreateInfo create = createInfo(info);
    const VkDeviceImageMemoryRequirements query{.sType = VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS, .pCreateInfo = &create};
    VkMemoryRequirements2 needs{.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    vkGetDeviceImageMemoryRequirements(device.handle(), &query, &needs);
    return needs.memoryRequirements;
}

void transition(VkCommandBuffer commands, VkImage image, MipRange mips, VkImageLayout from, VkImageLayout to)
{
    const VkImageMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                                        .oldLayout = from,
                                        .newLayout = to,
                                        .image = image,
                                        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, mips.first, mips.count, 0, 1}};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

Image uploadedImage(Device& device, std::string_view label, const ImageInfo& info, std::span<const std::byte> texels)
{
    check(texels.size() == size_t{info.extent.x} * info.extent.y * bytesPerPixel(info.format), "texels that fill the image");
    ImageInfo filled = info;
    filled.usage |= VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    Image image(device, label, filled);
    const Buffer staging(device, "staging", texels.size(), MemoryKind::Upload);
    std::memcpy(staging.mapped(), texels.data(), texels.size());
    device.submitNow([&](VkCommandBuffer commands) {
        transition(commands, image.handle(), {0, filled.mipLevels}, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {filled.extent.x, filled.extent.y, 1}};
        vkCmdCopyBufferToImage(commands, staging.handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        fillMips(commands, image);
    });
    return image;
}

} // namespace antumbra::gpu
