#include "gpu/pipeline.h"

#include <array>
#include <utility>

namespace antumbra::gpu {

namespace {

/// A module that lives until its pipeline is made.
class ShaderModule
{
public:
    ShaderModule(Device& device, std::string_view file, std::span<const ShaderDefine> defines) : device_(device)
    {
        const std::vector<uint32_t> words = compileShader(file, defines);
        const VkShaderModuleCreateInfo info{
            .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = words.size() * 4, .pCode = words.data()};
        require(vkCreateShaderModule(device.handle(), &info, nullptr, &module_), "vkCreateShaderModule");
    }
    ~ShaderModule() { vkDestroyShaderModule(device_.handle(), module_, nullptr); }
    ShaderModule(const ShaderModule&) = delete;
    ShaderModule& operator=(const ShaderModule&) = delete;

    [[nodiscard]] VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit) const
    {
        return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = bit, .module = module_, .pName = "main"};
    }

private:
    Device& device_;
    VkShaderModule module_ = VK_NULL_HANDLE;
};

constexpr VkPipelineColorBlendAttachmentState blendState(bool blends)
{
    constexpr VkColorComponentFlags all =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    return {.blendEnable = blends ? VK_TRUE : VK_FALSE,
            .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
            .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
            .colorBlendOp = VK_BLEND_OP_ADD,
            .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
            .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
            .alphaBlendOp = VK_BLEND_OP_ADD,
            .colorWriteMask = all};
}

} // namespace

Pipeline::~Pipeline()
{
    if (device_ != nullptr)
        device_->retire({VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline_)});
}

void Pipeline::swap(Pipeline& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(pipeline_, other.pipeline_);
    std::swap(bindPoint_, other.bindPoint_);
}

Pipeline computePipeline(Device& device, std::string_view shader, std::span<const ShaderDefine> defines)
{
    const ShaderModule module(device, shader, defines);
    const VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .stage = module.stage(VK_SHADER_STAGE_COMPUTE_BIT),
                                           .layout = device.bindless().layout()};
    VkPipeline pipeline = VK_NULL_HANDLE;
    require(vkCreateComputePipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &pipeline), shader);
    device.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), shader);
    return {device, pipeline, VK_PIPELINE_BIND_POINT_COMPUTE};
}

Pipeline rasterPipeline(Device& device, const RasterState& state)
{
    const ShaderModule vertex(device, state.vertexShader, state.defines);
    const ShaderModule fragment(device, state.fragmentShader, state.defines);
    const std::array stages{vertex.stage(VK_SHADER_STAGE_VERTEX_BIT), fragment.stage(VK_SHADER_STAGE_FRAGMENT_BIT)};

    const VkPipelineVertexInputStateCreateInfo noVertexInput{.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo triangles{.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
                                                           .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo raster{.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
                                                        .polygonMode = VK_POLYGON_MODE_FILL,
                                                        .cullMode = VK_CULL_MODE_NONE,
                                                        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
                                                        .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo samples{.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                                                       .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const bool hasDepth = state.depthFormat != Format::Undefined;
    const VkPipelineDepthStencilStateCreateInfo depth{.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
                                                      .depthTestEnable = hasDepth ? VK_TRUE : VK_FALSE,
                                                      .depthWriteEnable = hasDepth && state.writesDepth ? VK_TRUE : VK_FALSE,
                                                      .depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL};
    std::vector<VkPipelineColorBlendAttachmentState> blends(state.colorFormats.size(), blendState(state.blends));
    const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                    .attachmentCount = static_cast<uint32_t>(blends.size()),
                                                    .pAttachments = blends.data()};
    constexpr std::array dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_CULL_MODE,
                                 VK_DYNAMIC_STATE_FRONT_FACE};
    const VkPipelineDynamicStateCreateInfo dynamicInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                       .dynamicStateCount = static_cast<uint32_t>(dynamic.size()),
                                                       .pDynamicStates = dynamic.data()};
    std::vector<VkFormat> formats;
    for (const Format format : state.colorFormats)
        formats.push_back(vulkanFormat(format));
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = static_cast<uint32_t>(formats.size()),
                                                  .pColorAttachmentFormats = formats.data(),
                                                  .depthAttachmentFormat = vulkanFormat(state.depthFormat)};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = static_cast<uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &noVertexInput,
                                            .pInputAssemblyState = &triangles,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamicInfo,
                                            .layout = device.bindless().layout()};
    VkPipeline pipeline = VK_NULL_HANDLE;
    require(vkCreateGraphicsPipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &pipeline), state.fragmentShader);
    device.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), state.fragmentShader);
    return {device, pipeline, VK_PIPELINE_BIND_POINT_GRAPHICS};
}

} // namespace antumbra::gpu
