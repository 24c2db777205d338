// Acceleration structures for ray queries: how large they get, and recording their builds.
#pragma once

#include "base/math.h"
#include "gpu/buffer.h"

namespace antumbra::gpu {

/// Triangles by address: tightly packed vec3 positions and 32-bit indices.
struct TriangleInput
{
    VkDeviceAddress positions = 0;
    VkDeviceAddress indices = 0;
    uint32_t vertexCount = 0;
    uint32_t triangleCount = 0;
};

/// Boxes that lie in a row, VkAabbPositionsKHR; a ray query gives each that it may meet as a candidate.
struct BoxInput
{
    VkDeviceAddress boxes = 0;
    uint32_t boxCount = 0;
};

struct AccelSizes
{
    VkDeviceSize structure = 0;
    VkDeviceSize scratch = 0; // rounded up to the device's alignment
};

/// Sizes for a structure of triangles that is rebuilt often (`isDynamic`: fast to build) or once (fast to trace).
AccelSizes trianglesSizes(Device& device, uint32_t vertexCount, uint32_t triangleCount, bool isDynamic);
/// Of boxes that are rebuilt often.
AccelSizes boxesSizes(Device& device, uint32_t boxCount);
AccelSizes instancesSizes(Device& device, uint32_t instanceCount);

/// An acceleration structure and the memory it lies in.
class Accel
{
public:
    Accel() = default;
    Accel(Device& device, std::string_view label, VkAccelerationStructureTypeKHR type, VkDeviceSize bytes);
    ~Accel();
    Accel(Accel&& other) noexcept { swap(other); }
    Accel& operator=(Accel&& other) noexcept
    {
        swap(other);
        return *this;
    }

    [[nodiscard]] VkAccelerationStructureKHR handle() const { return accel_; }
    [[nodiscard]] VkDeviceAddress address() const { return address_; }
    [[nodiscard]] size_t bytes() const { return storage_.bytes(); }
    explicit operator bool() const { return accel_ != VK_NULL_HANDLE; }

private:
    void swap(Accel& other) noexcept;

    Device* device_ = nullptr;
    Buffer storage_;
    VkAccelerationStructureKHR accel_ = VK_NULL_HANDLE;
    VkDeviceAddress address_ = 0;
};

/// Of both sides of triangles. Carries the mask, of at most 8 bits, as custom index too.
VkAccelerationStructureInstanceKHR instanceOf(const mat4& worldFromLocal, const Accel& accel, uint32_t mask);

/// The builds read and write device memory only; the caller orders them with barriers (Use::AccelBuildInput, Use::AccelWrite).
void recordBuild(VkCommandBuffer commands, const Accel& target, const TriangleInput& input, bool isDynamic, VkDeviceAddress scratch);
void recordBuild(VkCommandBuffer commands, const Accel& target, const BoxInput& input, VkDeviceAddress scratch);
void recordBuild(VkCommandBuffer commands, const Accel& target, VkDeviceAddress instances, uint32_t instanceCount, VkDeviceAddress scratch);

} // namespace antumbra::gpu
