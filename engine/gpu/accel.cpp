#include "gpu/accel.h"

#include <utility>

namespace antumbra::gpu {

namespace {

VkAccelerationStructureGeometryKHR triangleGeometry(const TriangleInput& input)
{
    VkAccelerationStructureGeometryKHR geometry{.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
                                                .geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR,
                                                .flags = VK_GEOMETRY_OPAQUE_BIT_KHR};
    geometry.geometry.triangles = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
                                   .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
                                   .vertexData = {.deviceAddress = input.positions},
                                   .vertexStride = 3 * sizeof(float),
                                   .maxVertex = input.vertexCount - 1,
                                   .indexType = VK_INDEX_TYPE_UINT32,
                                   .indexData = {.deviceAddress = input.indices},
                                   .transformData = {}};
    return geometry;
}

VkAccelerationStructureGeometryKHR boxGeometry(VkDeviceAddress boxes)
{
    VkAccelerationStructureGeometryKHR geometry{.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
                                                .geometryType = VK_GEOMETRY_TYPE_AABBS_KHR};
    geometry.geometry.aabbs = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR,
                               .data = {.deviceAddress = boxes},
                               .stride = sizeof(VkAabbPositionsKHR)};
    return geometry;
}

VkAccelerationStructureGeometryKHR instanceGeometry(VkDeviceAddress instances)
{
    VkAccelerationStructureGeometryKHR geometry{.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
                                                .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR};
    geometry.geometry.instances = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
                                   .data = {.deviceAddress = instances}};
    return geometry;
}

VkAccelerationStructureBuildGeometryInfoKHR buildInfo(const VkAccelerationStructureGeometryKHR& geometry, bool isBottom, bool isDynamic)
{
    return {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
            .type = isBottom ? VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR : VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR,
            .flags = isDynamic ? VkBuildAccelerationStructureFlagsKHR{VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR}
                               : VkBuildAccelerationStructureFlagsKHR{VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR},
            .mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR,
            .geometryCount = 1,
            .pGeometries = &geometry};
}

AccelSizes sizesOf(Device& device, const VkAccelerationStructureBuildGeometryInfoKHR& info, uint32_t primitiveCount)
{
    VkAccelerationStructureBuildSizesInfoKHR sizes{.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    vkGetAccelerationStructureBuildSizesKHR(device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &primitiveCount,
                                            &sizes);
    const VkDeviceSize alignment = device.info().accelScratchAlignment;
    return {sizes.accelerationStructureSize, (sizes.buildScratchSize + alignment - 1) / alignment * alignment};
}

void record(VkCommandBuffer commands, VkAccelerationStructureBuildGeometryInfoKHR info, const Accel& target, uint32_t primitiveCount,
            VkDeviceAddress scratch)
{
    info.dstAccelerationStructure = target.handle();
    info.scratchData.deviceAddress = scratch;
    const VkAccelerationStructureBuildRangeInfoKHR range{.primitiveCount = primitiveCount};
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    vkCmdBuildAccelerationStructuresKHR(commands, 1, &info, &ranges);
}

} // namespace

AccelSizes trianglesSizes(Device& device, uint32_t vertexCount, uint32_t triangleCount, bool isDynamic)
{
    const auto geometry = triangleGeometry({.vertexCount = vertexCount});
    return sizesOf(device, buildInfo(geometry, true, isDynamic), triangleCount);
}

AccelSizes boxesSizes(Device& device, uint32_t boxCount)
{
    const auto geometry = boxGeometry(0);
    return sizesOf(device, buildInfo(geometry, true, true), boxCount);
}

AccelSizes instancesSizes(Device& device, uint32_t instanceCount)
{
    const auto geometry = instanceGeometry(0);
    return sizesOf(device, buildInfo(geometry, false, true), instanceCount);
}

Accel::Accel(Device& device, std::string_view label, VkAccelerationStructureTypeKHR type, VkDeviceSize bytes)
    : device_(&device), storage_(device, label, bytes)
{
    const VkAccelerationStructureCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR, .buffer = storage_.handle(), .size = bytes, .type = type};
    require(vkCreateAccelerationStructureKHR(device.handle(), &info, nullptr, &accel_), "vkCreateAccelerationStructureKHR");
    const VkAccelerationStructureDeviceAddressInfoKHR address{.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
                                                              .accelerationStructure = accel_};
    address_ = vkGetAccelerationStructureDeviceAddressKHR(device.handle(), &address);
}

Accel::~Accel()
{
    if (device_ != nullptr)
        device_->retire({VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, reinterpret_cast<uint64_t>(accel_)});
}

void Accel::swap(Accel& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(storage_, other.storage_);
    std::swap(accel_, other.accel_);
    std::swap(address_, other.address_);
}

VkAccelerationStructureInstanceKHR instanceOf(const mat4& worldFromLocal, const Accel& accel, uint32_t mask)
{
    VkAccelerationStructureInstanceKHR instance{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            instance.transform.matrix[row][column] = worldFromLocal[column][row];
    instance.instanceCustomIndex = mask & 0xffffffu;
    instance.mask = mask & 0xffu;
    instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    instance.accelerationStructureReference = accel.address();
    return instance;
}

void recordBuild(VkCommandBuffer commands, const Accel& target, const TriangleInput& input, bool isDynamic, VkDeviceAddress scratch)
{
    const auto geometry = triangleGeometry(input);
    record(commands, buildInfo(geometry, true, isDynamic), target, input.triangleCount, scratch);
}

void recordBuild(VkCommandBuffer commands, const Accel& target, const BoxInput& input, VkDeviceAddress scratch)
{
    const auto geometry = boxGeometry(input.boxes);
    record(commands, buildInfo(geometry, true, true), target, input.boxCount, scratch);
}

void recordBuild(VkCommandBuffer commands, const Accel& target, VkDeviceAddress instances, uint32_t instanceCount, VkDeviceAddress scratch)
{
    const auto geometry = instanceGeometry(instances);
    record(commands, buildInfo(geometry, false, true), target, instanceCount, scratch);
}

} // namespace antumbra::gpu
