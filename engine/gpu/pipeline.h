// Pipelines from shader files. All share one layout: the bindless set and 128 bytes of push constants.
#pragma once

#include "gpu/device.h"
#include "gpu/shaders.h"

namespace antumbra::gpu {

/// How triangles become pixels; everything a graphics pipeline is made from.
struct RasterState
{
    std::string_view vertexShader;
    std::string_view fragmentShader;
    std::span<const ShaderDefine> defines = {};
    std::span<const Format> colorFormats = {};
    Format depthFormat = Format::Undefined; // reversed depth: greater is nearer
    bool writesDepth = true;
    bool blends = false; // source over, by the shader's alpha
};

class Pipeline
{
public:
    Pipeline() = default;
    ~Pipeline();
    Pipeline(Pipeline&& other) noexcept { swap(other); }
    Pipeline& operator=(Pipeline&& other) noexcept
    {
        swap(other);
        return *this;
    }

    [[nodiscard]] VkPipeline handle() const { return pipeline_; }
    [[nodiscard]] VkPipelineBindPoint bindPoint() const { return bindPoint_; }
    explicit operator bool() const { return pipeline_ != VK_NULL_HANDLE; }

    friend Pipeline computePipeline(Device& device, std::string_view shader, std::span<const ShaderDefine> defines);
    friend Pipeline rasterPipeline(Device& device, const RasterState& state);

private:
    Pipeline(Device& device, VkPipeline pipeline, VkPipelineBindPoint bindPoint)
        : device_(&device), pipeline_(pipeline), bindPoint_(bindPoint)
    {
    }
    void swap(Pipeline& other) noexcept;

    Device* device_ = nullptr;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkPipelineBindPoint bindPoint_ = VK_PIPELINE_BIND_POINT_COMPUTE;
};

/// Throw Error where a shader does not compile. Culling of faces is dynamic state: see Recorder.
Pipeline computePipeline(Device& device, std::string_view shader, std::span<const ShaderDefine> defines = {});
Pipeline rasterPipeline(Device& device, const RasterState& state);

} // namespace antumbra::gpu
