// The Vulkan device: chosen and probed once, then the owner of memory, descriptors, frames in flight and late destruction.
// Everything that lives on the device is made from one of these and must not outlive it.
#pragma once

#include "gpu/bindless.h"
#include "gpu/memory.h"
#include "gpu/vulkan.h"

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace antumbra::gpu {

inline constexpr uint32_t kFramesInFlight = 2;

struct DeviceOptions
{
    bool validation = false;                            // messages are collected, see Device::validationMessages
    std::span<const char* const> windowExtensions = {}; // what the window system asks of the instance; empty: headless
};

struct DeviceInfo
{
    std::string name;
    std::string driver; // name and version
    std::string api;    // "1.3.239"
    bool isCpu = false;
    bool rayQuery = false;
    std::vector<std::string> missingOptional; // features an effect could use, by name
    uint32_t subgroupSize = 1;
    float nanosecondsPerTick = 0; // 0: no timestamps
    uint32_t accelScratchAlignment = 1;
};

/// A device object whose handle is given up; destroyed when no frame in flight can use it any more.
struct Retired
{
    VkObjectType type = VK_OBJECT_TYPE_UNKNOWN;
    uint64_t handle = 0;
    Allocation allocation{};
    uint32_t sampledSlot = kNoSlot; // of an image view
    uint32_t storageSlot = kNoSlot;
    uint32_t bufferSlot = kNoSlot; // of a buffer
};

/// A linear store the host writes each frame and the device reads by address.
struct FrameBytes
{
    std::byte* mapped = nullptr;
    VkDeviceAddress address = 0;
};

class Device
{
public:
    /// Throws Error (exit 3) that names what is missing where no device will do.
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const DeviceInfo& info() const { return info_; }
    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] uint32_t queueFamily() const { return queueFamily_; }
    [[nodiscard]] Memory& memory() { return *memory_; }
    [[nodiscard]] Bindless& bindless() { return *bindless_; }
    [[nodiscard]] VkPipelineCache pipelineCache() const { return pipelineCache_; }

    /// Waits until the slot's last frame is done, destroys what that frame retired, and opens its command buffer.
    VkCommandBuffer beginFrame();
    /// Closes and submits. Semaphores may be null (headless).
    void endFrame(VkSemaphore waitFor, VkSemaphore signal);
    /// Bytes for this frame only, aligned to 16. Grows between frames when it was too small, so steady frames never grow.
    FrameBytes frameBytes(size_t bytes);
    [[nodiscard]] uint32_t frameSlot() const { return static_cast<uint32_t>(frameNumber_ % kFramesInFlight); }
    [[nodiscard]] uint64_t frameNumber() const { return frameNumber_; }

    /// Records, submits and waits; for loading, never in a frame.
    void submitNow(const std::function<void(VkCommandBuffer)>& record);
    /// Only for shutdown, resize and reading back between frames.
    void waitIdle();

    void retire(Retired retired);
    void name(VkObjectType type, uint64_t handle, std::string_view label);
    [[nodiscard]] const std::vector<std::string>& validationMessages() const { return *validationMessages_; }

private:
    struct Frame
    {
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence done = VK_NULL_HANDLE;
        VkBuffer store = VK_NULL_HANDLE;
        Allocation storeMemory{};
        VkDeviceAddress storeAddress = 0;
        size_t storeUsed = 0;
        size_t storeWanted = 0;
        std::vector<Retired> retired;
    };

    void createInstance(const DeviceOptions& options);
    void choosePhysical();
    void createDevice(bool presents);
    void createFrames();
    void growStore(Frame& frame, size_t bytes);
    void loadPipelineCache();
    void savePipelineCache() const;
    void destroy(const Retired& retired);
    Frame& frame() { return frames_[frameSlot()]; }

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::unique_ptr<std::vector<std::string>> validationMessages_ = std::make_unique<std::vector<std::string>>();
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    DeviceInfo info_;
    VkPipelineCache pipelineCache_ = VK_NULL_HANDLE;
    std::unique_ptr<Memory> memory_;
    std::unique_ptr<Bindless> bindless_;
    std::array<Frame, kFramesInFlight> frames_;
    VkCommandPool immediatePool_ = VK_NULL_HANDLE;
    uint64_t frameNumber_ = 0;
    bool isRecording_ = false; // between beginFrame and endFrame
};

} // namespace antumbra::gpu
