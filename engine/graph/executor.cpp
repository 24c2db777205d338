#include "graph/executor.h"

#include "base/check.h"

#include <algorithm>
#include <array>

namespace antumbra::graph {

namespace {

struct Scope
{
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;

    Scope& operator|=(const Scope& other)
    {
        stages |= other.stages;
        access |= other.access;
        return *this;
    }
};

constexpr VkPipelineStageFlags2 kShaders =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepthTests = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

Scope scopeOf(Use use)
{
    switch (use) {
    case Use::Sampled: return {kShaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    case Use::StorageRead: return {kShaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    case Use::StorageWrite: return {kShaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    case Use::ColorAttachment:
        return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    case Use::DepthAttachment:
        return {kDepthTests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    case Use::DepthRead:
        return {kDepthTests | kShaders, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    case Use::TransferRead: return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    case Use::TransferWrite: return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    case Use::Present: return {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
    case Use::AccelBuildInput: return {VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, VK_ACCESS_2_SHADER_READ_BIT};
    case Use::AccelWrite:
        return {VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR | VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR};
    case Use::AccelRead:
        return {kShaders | VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR};
    case Use::Indirect: return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};
    case Use::VertexRead: return {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    case Use::HostRead: return {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    }
    return {};
}

/// The empty set stands for anything that came before.
Scope scopeOf(UseSet uses)
{
    if (uses.empty())
        return {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT};
    Scope scope;
    uses.forEach([&](Use use) { scope |= scopeOf(use); });
    return scope;
}

VkImageLayout vulkanLayout(Layout layout)
{
    switch (layout) {
    case Layout::Undefined: return VK_IMAGE_LAYOUT_UNDEFINED;
    case Layout::General: return VK_IMAGE_LAYOUT_GENERAL;
    case Layout::ReadOnly: return VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
    case Layout::Attachment: return VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    case Layout::TransferSource: return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case Layout::TransferTarget: return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    case Layout::Present: return VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    }
    return VK_IMAGE_LAYOUT_UNDEFINED;
}

VkImageUsageFlags usageOf(UseSet uses)
{
    VkImageUsageFlags usage = 0;
    uses.forEach([&](Use use) {
        switch (use) {
        case Use::Sampled: usage |= VK_IMAGE_USAGE_SAMPLED_BIT; break;
        case Use::StorageRead:
        case Use::StorageWrite: usage |= VK_IMAGE_USAGE_STORAGE_BIT; break;
        case Use::ColorAttachment: usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT; break;
        case Use::DepthAttachment: usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT; break;
        case Use::DepthRead: usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT; break;
        case Use::TransferRead: usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT; break;
        case Use::TransferWrite: usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT; break;
        default: break;
        }
    });
    return usage;
}

constexpr size_t kMostRealisations = 8;

// A pair is used differently from frame to frame and must outlive that.
constexpr UseSet kHistoryUses = Use::Sampled | Use::StorageWrite | Use::TransferRead | Use::TransferWrite;

} // namespace

void Recorder::bind(const gpu::Pipeline& pipeline, const void* push, size_t bytes)
{
    check(bytes <= 128, "push constants of at most 128 bytes");
    if (bound_ != pipeline.handle())
        vkCmdBindPipeline(commands_, pipeline.bindPoint(), pipeline.handle());
    bound_ = pipeline.handle();
    vkCmdPushConstants(commands_, layout_, VK_SHADER_STAGE_ALL, 0, static_cast<uint32_t>(bytes), push);
}

void Recorder::drawBound(const gpu::Buffer& indices, uint32_t indexCount, Faces faces, uint32_t firstIndex, VkIndexType type,
                         int32_t vertexOffset)
{
    vkCmdSetCullMode(commands_, faces == Faces::Both ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
    vkCmdSetFrontFace(commands_, faces == Faces::FrontMirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
    vkCmdBindIndexBuffer(commands_, indices.handle(), 0, type);
    vkCmdDrawIndexed(commands_, indexCount, 1, firstIndex, vertexOffset, 0);
}

void Recorder::orderWithinPass() const
{
    constexpr VkPipelineStageFlags2 stages =
        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
    const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = stages,
                                   .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                   .dstStageMask = stages,
                                   .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands_, &dependency);
}

gpu::ImageInfo Executor::infoOf(const Resource& resource, UseSet uses) const
{
    return {.format = resource.image.format, .extent = resource.image.extent, .usage = usageOf(uses)};
}

Executor::Realisation& Executor::realise(const Plan& plan, const FrameGraph& graph)
{
    needs_.clear();
    for (const uint32_t index : plan.transients) {
        const Resource& resource = graph.resources()[index];
        const PlannedResource& planned = plan.resources[index];
        needs_.push_back({resource.kind, resource.kind == Kind::Image ? infoOf(resource, planned.uses) : gpu::ImageInfo{},
                          resource.kind == Kind::Buffer ? resource.bytes : 0, planned.memory});
    }
    const auto known = std::ranges::find(realisations_, needs_, &Realisation::needs);
    if (known != realisations_.end())
        return *known;
    if (realisations_.size() >= kMostRealisations) {
        const auto oldest = std::ranges::min_element(realisations_, {}, &Realisation::lastFrame);
        retire(*oldest);
        realisations_.erase(oldest);
    }
    realisations_.push_back({.needs = needs_});
    make(realisations_.back(), plan, graph);
    return realisations_.back();
}

void Executor::make(Realisation& realisation, const Plan& plan, const FrameGraph& graph)
{
    realisation.buffers.resize(plan.memory.size());
    realisation.allocations.resize(plan.memory.size());
    std::vector<VkMemoryRequirements> needs(plan.memory.size(), VkMemoryRequirements{.alignment = 1, .memoryTypeBits = ~0u});
    for (const Need& need : realisation.needs)
        if (need.kind == Kind::Image) {
            const VkMemoryRequirements own = gpu::Image::requirements(*device_, need.image);
            VkMemoryRequirements& shared = needs[need.memory];
            shared.size = std::max(shared.size, own.size);
            shared.alignment = std::max(shared.alignment, own.alignment);
            shared.memoryTypeBits &= own.memoryTypeBits;
        }
    for (size_t i = 0; i < plan.memory.size(); ++i) {
        if (plan.memory[i].kind == Kind::Image) {
            realisation.allocations[i] = device_->memory().allocate(needs[i], gpu::MemoryKind::Device, true);
            realisation.bytes += needs[i].size;
        } else {
            realisation.buffers[i] = gpu::Buffer(*device_, "transient buffers", plan.memory[i].bytes);
            realisation.bytes += plan.memory[i].bytes;
        }
    }
    for (size_t i = 0; i < realisation.needs.size(); ++i) {
        const Need& need = realisation.needs[i];
        const std::string_view label = graph.resources()[plan.transients[i]].label;
        realisation.images.push_back(
            need.kind == Kind::Image ? gpu::Image(*device_, label, need.image, realisation.allocations[need.memory], 0) : gpu::Image());
    }
}

void Executor::retire(Realisation& realisation)
{
    realisation.images.clear(); // before the memory they lie in
    for (const gpu::Allocation& allocation : realisation.allocations)
        device_->retire({VK_OBJECT_TYPE_DEVICE_MEMORY, 0, allocation});
}

const gpu::Image& Executor::historySide(uint64_t token, const gpu::ImageInfo& info, std::string_view label)
{
    const size_t id = token / 2;
    if (histories_.size() <= id)
        histories_.resize(id + 1);
    HistoryPair& pair = histories_[id];
    if (pair.info != info) {
        pair.info = info;
        for (gpu::Image& side : pair.sides)
            side = gpu::Image(*device_, label, info);
    }
    return pair.sides[token % 2];
}

void Executor::resolve(const Plan& plan, const FrameGraph& graph)
{
    const std::span<const Resource> resources = graph.resources();
    images_.assign(resources.size(), nullptr);
    buffers_.assign(resources.size(), nullptr);
    Realisation& realisation = realise(plan, graph);
    realisation.lastFrame = device_->frameNumber();
    for (size_t i = 0; i < plan.transients.size(); ++i) {
        const uint32_t index = plan.transients[i];
        if (resources[index].kind == Kind::Image)
            images_[index] = &realisation.images[i];
        else
            buffers_[index] = &realisation.buffers[plan.resources[index].memory];
    }
    for (size_t i = 0; i < resources.size(); ++i) {
        const Resource& resource = resources[i];
        if (resource.origin == Origin::Imported && resource.kind == Kind::Image)
            images_[i] = reinterpret_cast<const gpu::Image*>(resource.token);
        else if (resource.origin == Origin::Imported)
            buffers_[i] = reinterpret_cast<const gpu::Buffer*>(resource.token);
        else if (resource.origin != Origin::Transient && plan.resources[i].first != kNone)
            images_[i] = &historySide(resource.token, infoOf(resource, kHistoryUses), resource.label);
    }
}

void Executor::recordBarriers(std::span<const Barrier> barriers, const FrameGraph& graph)
{
    imageBarriers_.clear();
    Scope from, to;
    for (const Barrier& barrier : barriers) {
        const Scope source = scopeOf(barrier.from), target = scopeOf(barrier.to);
        if (graph.resources()[barrier.resource].kind == Kind::Buffer) {
            from |= source;
            to |= target;
            continue;
        }
        const gpu::Image& image = *images_[barrier.resource];
        imageBarriers_.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                  .srcStageMask = source.stages,
                                  .srcAccessMask = source.access,
                                  .dstStageMask = target.stages,
                                  .dstAccessMask = target.access,
                                  .oldLayout = barrier.discard ? VK_IMAGE_LAYOUT_UNDEFINED : vulkanLayout(layoutOf(barrier.from)),
                                  .newLayout = vulkanLayout(layoutOf(barrier.to)),
                                  .image = image.handle(),
                                  .subresourceRange = {image.aspect(), 0, 1, 0, 1}});
    }
    if (imageBarriers_.empty() && from.stages == 0)
        return;
    const VkMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .srcStageMask = from.stages,
                                  .srcAccessMask = from.access,
                                  .dstStageMask = to.stages,
                                  .dstAccessMask = to.access};
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .memoryBarrierCount = from.stages != 0 ? 1u : 0u,
                                      .pMemoryBarriers = &memory,
                                      .imageMemoryBarrierCount = static_cast<uint32_t>(imageBarriers_.size()),
                                      .pImageMemoryBarriers = imageBarriers_.data()};
    vkCmdPipelineBarrier2(recorder_.commands_, &dependency);
}

void Executor::beginAttachments(std::span<const Attachment> attachments, const FrameGraph& graph)
{
    std::array<VkRenderingAttachmentInfo, 8> colors{};
    uint32_t colorCount = 0;
    VkRenderingAttachmentInfo depth{};
    bool hasDepth = false;
    uvec2 extent{0};
    for (const Attachment& attachment : attachments) {
        const Resource& resource = graph.resources()[attachment.resource];
        const vec4 clear = resource.image.clear.value_or(vec4{0});
        extent = images_[attachment.resource]->info().extent;
        VkRenderingAttachmentInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                       .imageView = images_[attachment.resource]->view(),
                                       .imageLayout = vulkanLayout(layoutOf(attachment.use)),
                                       .loadOp = attachment.load == Load::Keep    ? VK_ATTACHMENT_LOAD_OP_LOAD
                                                 : attachment.load == Load::Clear ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                                                                  : VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                       .storeOp = attachment.store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE};
        if (attachment.use == Use::ColorAttachment) {
            info.clearValue.color = {{clear.x, clear.y, clear.z, clear.w}};
            colors.at(colorCount++) = info;
        } else {
            info.clearValue.depthStencil = {clear.x, 0};
            depth = info;
            hasDepth = true;
        }
    }
    const VkRect2D area{{0, 0}, {extent.x, extent.y}};
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = area,
                                    .layerCount = 1,
                                    .colorAttachmentCount = colorCount,
                                    .pColorAttachments = colors.data(),
                                    .pDepthAttachment = hasDepth ? &depth : nullptr};
    vkCmdBeginRendering(recorder_.commands_, &rendering);
    const VkViewport viewport{0, 0, static_cast<float>(extent.x), static_cast<float>(extent.y), 0, 1};
    vkCmdSetViewport(recorder_.commands_, 0, 1, &viewport);
    vkCmdSetScissor(recorder_.commands_, 0, 1, &area);
    vkCmdSetCullMode(recorder_.commands_, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(recorder_.commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

void Executor::recordStep(const Plan& plan, const FrameGraph& graph, const Step& step)
{
    const PassNode& pass = graph.passes()[step.pass];
    recordBarriers(plan.barriersOf(step.barriers), graph);
    const std::span<const Attachment> attachments = plan.attachmentsOf(step);
    if (!attachments.empty())
        beginAttachments(attachments, graph);
    if (pass.commands)
        pass.commands(recorder_);
    if (!attachments.empty())
        vkCmdEndRendering(recorder_.commands_);
}

void Executor::execute(const Plan& plan, const FrameGraph& graph, VkCommandBuffer commands)
{
    std::vector<std::string_view>& names = names_[device_->frameSlot()];
    timers_.beginFrame();
    done_.clear();
    for (uint32_t i = 0; i < names.size(); ++i)
        done_.push_back({names[i], timers_.milliseconds(i)});
    names.clear();

    resolve(plan, graph);
    recorder_.commands_ = commands;
    recorder_.layout_ = device_->bindless().layout();
    recorder_.bound_ = VK_NULL_HANDLE;
    recorder_.images_ = images_.data();
    recorder_.buffers_ = buffers_.data();
    for (const Step& step : plan.steps) {
        names.push_back(graph.passes()[step.pass].name);
        timers_.begin(commands);
        recordStep(plan, graph, step);
        timers_.end(commands);
    }
    recordBarriers(plan.barriersOf(plan.finalBarriers), graph);
}

uint64_t Executor::transientBytes() const
{
    uint64_t bytes = 0;
    for (const Realisation& realisation : realisations_)
        bytes += realisation.bytes;
    return bytes;
}

uint64_t Executor::historyBytes() const
{
    uint64_t bytes = 0;
    for (const HistoryPair& pair : histories_)
        bytes += 2ull * pair.info.extent.x * pair.info.extent.y * bytesPerPixel(pair.info.format);
    return bytes;
}

} // namespace antumbra::graph
