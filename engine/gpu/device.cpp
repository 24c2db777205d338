#include "gpu/device.h"

#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"

#include <cstdlib>
#include <limits>

namespace antumbra::gpu {

namespace {

constexpr size_t kFirstStoreBytes = size_t{1} << 20;

/// Where compiled pipelines are kept between runs; empty where there is no home.
Path cacheFolder()
{
    if (const char* cache = std::getenv("XDG_CACHE_HOME"))
        return Path(cache) / "antumbra";
    if (const char* home = std::getenv("HOME"))
        return Path(home) / ".cache" / "antumbra";
    return {};
}

template <class Handle>
Handle handleOf(const Retired& retired)
{
    return reinterpret_cast<Handle>(retired.handle);
}

} // namespace

Device::Device(const DeviceOptions& options)
{
    createInstance(options);
    choosePhysical();
    createDevice(!options.windowExtensions.empty());
    memory_ = std::make_unique<Memory>(physical_, device_);
    bindless_ = std::make_unique<Bindless>(device_);
    loadPipelineCache();
    createFrames();
}

Device::~Device()
{
    vkDeviceWaitIdle(device_);
    savePipelineCache();
    for (Frame& frame : frames_) {
        for (const Retired& retired : frame.retired)
            destroy(retired);
        vkDestroyBuffer(device_, frame.store, nullptr);
        vkDestroyFence(device_, frame.done, nullptr);
        vkDestroyCommandPool(device_, frame.pool, nullptr);
    }
    vkDestroyCommandPool(device_, immediatePool_, nullptr);
    vkDestroyPipelineCache(device_, pipelineCache_, nullptr);
    bindless_.reset();
    memory_.reset();
    vkDestroyDevice(device_, nullptr);
    if (messenger_ != VK_NULL_HANDLE)
        vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

void Device::createFrames()
{
    const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = queueFamily_};
    const VkFenceCreateInfo fenceInfo{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .flags = VK_FENCE_CREATE_SIGNALED_BIT};
    for (Frame& frame : frames_) {
        require(vkCreateCommandPool(device_, &poolInfo, nullptr, &frame.pool), "vkCreateCommandPool");
        const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = frame.pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
        require(vkAllocateCommandBuffers(device_, &info, &frame.commands), "vkAllocateCommandBuffers");
        require(vkCreateFence(device_, &fenceInfo, nullptr, &frame.done), "vkCreateFence");
        growStore(frame, kFirstStoreBytes);
    }
    require(vkCreateCommandPool(device_, &poolInfo, nullptr, &immediatePool_), "vkCreateCommandPool");
}

void Device::growStore(Frame& frame, size_t bytes)
{
    if (frame.store != VK_NULL_HANDLE) {
        vkDestroyBuffer(device_, frame.store, nullptr);
        memory_->free(frame.storeMemory);
    }
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = bytes,
        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                 (info_.rayQuery ? VkBufferUsageFlags{VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR} : 0u)};
    require(vkCreateBuffer(device_, &info, nullptr, &frame.store), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_, frame.store, &needs);
    frame.storeMemory = memory_->allocate(needs, MemoryKind::Upload, false);
    require(vkBindBufferMemory(device_, frame.store, frame.storeMemory.memory, frame.storeMemory.offset), "vkBindBufferMemory");
    const VkBufferDeviceAddressInfo address{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, .buffer = frame.store};
    frame.storeAddress = vkGetBufferDeviceAddress(device_, &address);
}

VkCommandBuffer Device::beginFrame()
{
    Frame& now = frame();
    require(vkWaitForFences(device_, 1, &now.done, VK_TRUE, std::numeric_limits<uint64_t>::max()), "vkWaitForFences");
    for (const Retired& retired : now.retired)
        destroy(retired);
    now.retired.clear();
    if (now.storeWanted > now.storeMemory.size)
        growStore(now, 2 * now.storeWanted);
    now.storeUsed = 0;
    now.storeWanted = 0;
    require(vkResetCommandPool(device_, now.pool, 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    require(vkBeginCommandBuffer(now.commands, &begin), "vkBeginCommandBuffer");
    bindless_->bind(now.commands);
    isRecording_ = true;
    return now.commands;
}

void Device::endFrame(VkSemaphore waitFor, VkSemaphore signal)
{
    Frame& now = frame();
    require(vkEndCommandBuffer(now.commands), "vkEndCommandBuffer");
    require(vkResetFences(device_, 1, &now.done), "vkResetFences");
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, .commandBuffer = now.commands};
    const VkSemaphoreSubmitInfo wait{
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, .semaphore = waitFor, .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSemaphoreSubmitInfo done{
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, .semaphore = signal, .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .waitSemaphoreInfoCount = waitFor != VK_NULL_HANDLE ? 1u : 0u,
                               .pWaitSemaphoreInfos = &wait,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &commands,
                               .signalSemaphoreInfoCount = signal != VK_NULL_HANDLE ? 1u : 0u,
                               .pSignalSemaphoreInfos = &done};
    require(vkQueueSubmit2(queue_, 1, &submit, now.done), "vkQueueSubmit2");
    ++frameNumber_;
    isRecording_ = false;
}

FrameBytes Device::frameBytes(size_t bytes)
{
    Frame& now = frame();
    const size_t rounded = (bytes + 15) / 16 * 16;
    now.storeWanted += rounded;
    if (now.storeUsed + rounded > now.storeMemory.size) {
        // The old store stays until this frame is done; earlier ranges of it remain valid.
        retire({VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(now.store), now.storeMemory});
        now.store = VK_NULL_HANDLE;
        growStore(now, 2 * now.storeWanted);
        now.storeUsed = 0;
    }
    const FrameBytes range{now.storeMemory.mapped + now.storeUsed, now.storeAddress + now.storeUsed};
    now.storeUsed += rounded;
    return range;
}

void Device::submitNow(const std::function<void(VkCommandBuffer)>& record)
{
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = immediatePool_,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    require(vkAllocateCommandBuffers(device_, &info, &commands), "vkAllocateCommandBuffers");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    require(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    bindless_->bind(commands);
    record(commands);
    require(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    const VkCommandBufferSubmitInfo commandInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, .commandBuffer = commands};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2, .commandBufferInfoCount = 1, .pCommandBufferInfos = &commandInfo};
    require(vkQueueSubmit2(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
    require(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
    vkFreeCommandBuffers(device_, immediatePool_, 1, &commands);
}

void Device::waitIdle() { require(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle"); }

void Device::retire(Retired retired)
{
    // Between frames, the one that was submitted last may still use it.
    const uint64_t user = isRecording_ ? frameNumber_ : frameNumber_ + kFramesInFlight - 1;
    frames_[user % kFramesInFlight].retired.push_back(retired);
}

void Device::destroy(const Retired& retired)
{
    switch (retired.type) {
    case VK_OBJECT_TYPE_BUFFER:
        vkDestroyBuffer(device_, handleOf<VkBuffer>(retired), nullptr);
        if (retired.bufferSlot != kNoSlot)
            bindless_->freeBuffer(retired.bufferSlot);
        break;
    case VK_OBJECT_TYPE_IMAGE: vkDestroyImage(device_, handleOf<VkImage>(retired), nullptr); break;
    case VK_OBJECT_TYPE_IMAGE_VIEW:
        vkDestroyImageView(device_, handleOf<VkImageView>(retired), nullptr);
        if (retired.sampledSlot != kNoSlot)
            bindless_->freeSampled(retired.sampledSlot);
        if (retired.storageSlot != kNoSlot)
            bindless_->freeStorage(retired.storageSlot);
        break;
    case VK_OBJECT_TYPE_PIPELINE: vkDestroyPipeline(device_, handleOf<VkPipeline>(retired), nullptr); break;
    case VK_OBJECT_TYPE_QUERY_POOL: vkDestroyQueryPool(device_, handleOf<VkQueryPool>(retired), nullptr); break;
    case VK_OBJECT_TYPE_SEMAPHORE: vkDestroySemaphore(device_, handleOf<VkSemaphore>(retired), nullptr); break;
    case VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR:
        vkDestroyAccelerationStructureKHR(device_, handleOf<VkAccelerationStructureKHR>(retired), nullptr);
        break;
    case VK_OBJECT_TYPE_DEVICE_MEMORY: break; // only the range below
    default: check(false, "an object type that can be retired");
    }
    memory_->free(retired.allocation);
}

void Device::name(VkObjectType type, uint64_t handle, std::string_view label)
{
    if (messenger_ == VK_NULL_HANDLE)
        return;
    const std::string text(label);
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = handle,
                                             .pObjectName = text.c_str()};
    vkSetDebugUtilsObjectNameEXT(device_, &info);
}

void Device::loadPipelineCache()
{
    std::vector<std::byte> saved;
    const Path file = cacheFolder() / "pipelines.bin";
    if (!cacheFolder().empty() && std::filesystem::exists(file))
        try {
            saved = readFile(file);
        } catch (const Error& error) {
            logWarning("pipeline cache not read: {}", error.what());
        }
    const VkPipelineCacheCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO, .initialDataSize = saved.size(), .pInitialData = saved.data()};
    require(vkCreatePipelineCache(device_, &info, nullptr, &pipelineCache_), "vkCreatePipelineCache");
}

void Device::savePipelineCache() const
{
    size_t size = 0;
    if (cacheFolder().empty() || vkGetPipelineCacheData(device_, pipelineCache_, &size, nullptr) != VK_SUCCESS)
        return;
    std::vector<std::byte> data(size);
    if (vkGetPipelineCacheData(device_, pipelineCache_, &size, data.data()) != VK_SUCCESS)
        return;
    try {
        writeFile(cacheFolder() / "pipelines.bin", data);
    } catch (const Error& error) {
        logWarning("pipeline cache not saved: {}", error.what());
    }
}

} // namespace antumbra::gpu
