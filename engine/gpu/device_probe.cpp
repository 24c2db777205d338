// Finding a device: the instance, what each physical device can do, and the logical device with what the engine uses.
#include "gpu/device.h"

#include "base/error.h"
#include "base/log.h"

#include <algorithm>
#include <fmt/format.h>

#include <cstring>

namespace antumbra::gpu {

namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    auto& messages = *static_cast<std::vector<std::string>*>(user);
    messages.emplace_back(data->pMessage);
    logError("validation: {}", data->pMessage);
    return VK_FALSE;
}

template <class T, class Call>
std::vector<T> enumerate(Call call)
{
    uint32_t count = 0;
    call(&count, nullptr);
    std::vector<T> all(count);
    call(&count, all.data());
    all.resize(count);
    return all;
}

bool hasExtension(const std::vector<VkExtensionProperties>& all, const char* name)
{
    return std::ranges::any_of(all, [&](const VkExtensionProperties& each) { return std::strcmp(each.extensionName, name) == 0; });
}

/// Every feature structure the engine looks at, chained.
struct Features
{
    VkPhysicalDeviceFeatures2 core{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    VkPhysicalDeviceVulkan11Features v11{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features v13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR accel{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};

    explicit Features(bool rays)
    {
        core.pNext = &v11;
        v11.pNext = &v12;
        v12.pNext = &v13;
        if (rays) {
            v13.pNext = &accel;
            accel.pNext = &rayQuery;
        }
    }
    Features(const Features&) = delete;
};

struct Wish
{
    const char* name;
    VkBool32* has;
};

/// What the engine cannot do without.
std::vector<Wish> requiredFeatures(Features& f)
{
    return {{"shaderInt64", &f.core.features.shaderInt64},
            {"shaderStorageImageReadWithoutFormat", &f.core.features.shaderStorageImageReadWithoutFormat},
            {"shaderStorageImageWriteWithoutFormat", &f.core.features.shaderStorageImageWriteWithoutFormat},
            {"bufferDeviceAddress", &f.v12.bufferDeviceAddress},
            {"scalarBlockLayout", &f.v12.scalarBlockLayout},
            {"runtimeDescriptorArray", &f.v12.runtimeDescriptorArray},
            {"descriptorBindingPartiallyBound", &f.v12.descriptorBindingPartiallyBound},
            {"descriptorBindingSampledImageUpdateAfterBind", &f.v12.descriptorBindingSampledImageUpdateAfterBind},
            {"descriptorBindingStorageImageUpdateAfterBind", &f.v12.descriptorBindingStorageImageUpdateAfterBind},
            {"descriptorBindingStorageBufferUpdateAfterBind", &f.v12.descriptorBindingStorageBufferUpdateAfterBind},
            {"descriptorBindingUpdateUnusedWhilePending", &f.v12.descriptorBindingUpdateUnusedWhilePending},
            {"shaderSampledImageArrayNonUniformIndexing", &f.v12.shaderSampledImageArrayNonUniformIndexing},
            {"hostQueryReset", &f.v12.hostQueryReset},
            {"dynamicRendering", &f.v13.dynamicRendering},
            {"synchronization2", &f.v13.synchronization2},
            {"maintenance4", &f.v13.maintenance4}};
}

constexpr const char* kRayExtensions[] = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                          VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

bool offersRayQuery(VkPhysicalDevice physical)
{
    const auto extensions = enumerate<VkExtensionProperties>(
        [&](uint32_t* count, VkExtensionProperties* all) { vkEnumerateDeviceExtensionProperties(physical, nullptr, count, all); });
    if (!std::ranges::all_of(kRayExtensions, [&](const char* name) { return hasExtension(extensions, name); }))
        return false;
    Features has(true);
    vkGetPhysicalDeviceFeatures2(physical, &has.core);
    return has.accel.accelerationStructure == VK_TRUE && has.rayQuery.rayQuery == VK_TRUE;
}

std::vector<std::string> missingFeatures(VkPhysicalDevice physical)
{
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_3)
        return {"Vulkan 1.3"};
    Features has(false);
    vkGetPhysicalDeviceFeatures2(physical, &has.core);
    std::vector<std::string> missing;
    for (const Wish& wish : requiredFeatures(has))
        if (*wish.has == VK_FALSE)
            missing.emplace_back(wish.name);
    return missing;
}

/// Higher is better: a GPU before a CPU, ray queries before none.
int rank(VkPhysicalDevice physical)
{
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    const int kind = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU     ? 3
                     : properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU ? 2
                     : properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU            ? 0
                                                                                       : 1;
    return 2 * kind + (offersRayQuery(physical) ? 1 : 0);
}

std::string versionText(uint32_t version)
{
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version), VK_API_VERSION_PATCH(version));
}

} // namespace

void Device::createInstance(const DeviceOptions& options)
{
    if (volkInitialize() != VK_SUCCESS)
        throw Error("no Vulkan loader found (libvulkan.so.1)", "Vulkan", ExitCode::NoDevice);
    std::vector<const char*> extensions(options.windowExtensions.begin(), options.windowExtensions.end());
    std::vector<const char*> layers;
    if (options.validation) {
        const auto available =
            enumerate<VkLayerProperties>([](uint32_t* count, VkLayerProperties* all) { vkEnumerateInstanceLayerProperties(count, all); });
        constexpr const char* validation = "VK_LAYER_KHRONOS_validation";
        if (std::ranges::none_of(available, [&](const auto& layer) { return std::strcmp(layer.layerName, validation) == 0; }))
            throw Error("the validation layer is not installed", validation, ExitCode::NoDevice);
        layers.push_back(validation);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    const VkApplicationInfo application{
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "antumbra", .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = static_cast<uint32_t>(layers.size()),
                                    .ppEnabledLayerNames = layers.data(),
                                    .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    require(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
    volkLoadInstance(instance_);
    if (!options.validation)
        return;
    const VkDebugUtilsMessengerCreateInfoEXT messenger{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
                                                       .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                                                          VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                                                       .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
                                                       .pfnUserCallback = onMessage,
                                                       .pUserData = validationMessages_.get()};
    require(vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void Device::choosePhysical()
{
    auto all =
        enumerate<VkPhysicalDevice>([&](uint32_t* count, VkPhysicalDevice* found) { vkEnumeratePhysicalDevices(instance_, count, found); });
    if (all.empty())
        throw Error("no device found; Mesa's lavapipe (mesa-vulkan-drivers) runs on any CPU", "Vulkan", ExitCode::NoDevice);
    std::ranges::stable_sort(all, std::greater{}, rank);
    std::string reasons;
    for (const VkPhysicalDevice candidate : all) {
        const std::vector<std::string> missing = missingFeatures(candidate);
        if (missing.empty()) {
            physical_ = candidate;
            break;
        }
        VkPhysicalDeviceProperties properties{};
        vkGetPhysicalDeviceProperties(candidate, &properties);
        reasons += fmt::format("{}{} lacks {}", reasons.empty() ? "" : "; ", static_cast<const char*>(properties.deviceName),
                               fmt::join(missing, ", "));
    }
    if (physical_ == VK_NULL_HANDLE)
        throw Error(reasons, "no usable device", ExitCode::NoDevice);

    VkPhysicalDeviceAccelerationStructurePropertiesKHR accel{.sType =
                                                                 VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
    VkPhysicalDeviceVulkan12Properties v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceVulkan11Properties v11{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES, .pNext = &v12};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &v11};
    info_.rayQuery = offersRayQuery(physical_);
    if (info_.rayQuery)
        v12.pNext = &accel;
    vkGetPhysicalDeviceProperties2(physical_, &properties);
    info_.name = static_cast<const char*>(properties.properties.deviceName);
    info_.driver = fmt::format("{} {}", static_cast<const char*>(v12.driverName), static_cast<const char*>(v12.driverInfo));
    info_.api = versionText(properties.properties.apiVersion);
    info_.isCpu = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    info_.subgroupSize = v11.subgroupSize;
    info_.nanosecondsPerTick =
        properties.properties.limits.timestampComputeAndGraphics == VK_TRUE ? properties.properties.limits.timestampPeriod : 0.0f;
    info_.accelScratchAlignment = std::max(1u, accel.minAccelerationStructureScratchOffsetAlignment);
    if (!info_.rayQuery)
        info_.missingOptional.emplace_back("VK_KHR_ray_query with VK_KHR_acceleration_structure");
    if (info_.nanosecondsPerTick == 0.0f)
        info_.missingOptional.emplace_back("timestamps");
}

void Device::createDevice(bool presents)
{
    const auto families = enumerate<VkQueueFamilyProperties>(
        [&](uint32_t* count, VkQueueFamilyProperties* all) { vkGetPhysicalDeviceQueueFamilyProperties(physical_, count, all); });
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const auto family = std::ranges::find_if(families, [](const auto& each) { return (each.queueFlags & needed) == needed; });
    if (family == families.end())
        throw Error("no queue for graphics and compute", info_.name, ExitCode::NoDevice);
    queueFamily_ = static_cast<uint32_t>(family - families.begin());

    std::vector<const char*> extensions;
    if (presents)
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (info_.rayQuery)
        extensions.insert(extensions.end(), std::begin(kRayExtensions), std::end(kRayExtensions));
    Features features(info_.rayQuery);
    for (const Wish& wish : requiredFeatures(features))
        *wish.has = VK_TRUE;
    features.accel.accelerationStructure = VK_TRUE;
    features.rayQuery.rayQuery = VK_TRUE;

    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queueInfo{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueFamilyIndex = queueFamily_,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.core,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queueInfo,
                                  .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
    require(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    volkLoadDevice(device_);
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
}

} // namespace antumbra::gpu
