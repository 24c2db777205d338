#include "render/renderer.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace antumbra::render {

namespace {

using graph::ImageRef;
using graph::Use;

constexpr std::array<std::string_view, kAovCount> kAovNames{"color",  "irradiance", "unshadowed", "occluded", "albedo",
                                                            "normal", "depth",      "cones",      "steps"};

gpu::Image makePicture(gpu::Device& device, uvec2 extent)
{
    return {device,
            "picture",
            {.format = gpu::Format::Rgba8Unorm,
             .extent = extent,
             .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}};
}

void copyToBuffer(graph::Recorder& recorder, ImageRef image, VkBuffer target)
{
    const gpu::Image& source = recorder.image(image);
    const VkBufferImageCopy region{.imageSubresource = {source.aspect(), 0, 0, 1},
                                   .imageExtent = {source.info().extent.x, source.info().extent.y, 1}};
    vkCmdCopyImageToBuffer(recorder.commands(), source.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, 1, &region);
}

/// The picture as it is, in the window's order of channels.
void declarePresent(graph::FrameGraph& graph, ImageRef picture, const gpu::Image& window)
{
    graph::Pass pass = graph.add("present");
    pass.read(picture, Use::TransferRead);
    const ImageRef screen =
        graph.import("window", {.format = window.info().format, .extent = window.info().extent}, graph::importedImage(window), {});
    const ImageRef shown = pass.write(screen, Use::TransferWrite);
    pass.record([picture, shown](graph::Recorder& recorder) {
        const gpu::Image& from = recorder.image(picture);
        const gpu::Image& to = recorder.image(shown);
        const auto corner = [](uvec2 extent) { return VkOffset3D{static_cast<int32_t>(extent.x), static_cast<int32_t>(extent.y), 1}; };
        const VkImageBlit region{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .srcOffsets = {{}, corner(from.info().extent)},
                                 .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .dstOffsets = {{}, corner(to.info().extent)}};
        vkCmdBlitImage(recorder.commands(), from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(),
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
    });
    graph.output(shown, Use::Present);
}

/// One pixel as four floats.
vec4 unpacked(const std::byte* pixel, gpu::Format format)
{
    switch (format) {
    case gpu::Format::Rgba16Float: {
        uint64_t bits = 0;
        std::memcpy(&bits, pixel, sizeof(bits));
        return glm::unpackHalf4x16(bits);
    }
    case gpu::Format::Rgba16Snorm: {
        uint64_t bits = 0;
        std::memcpy(&bits, pixel, sizeof(bits));
        return glm::unpackSnorm4x16(bits);
    }
    case gpu::Format::Rgba8Srgb: {
        uint32_t bits = 0;
        std::memcpy(&bits, pixel, sizeof(bits));
        const vec4 encoded = glm::unpackUnorm4x8(bits);
        return {scene::srgbDecoded(encoded.x), scene::srgbDecoded(encoded.y), scene::srgbDecoded(encoded.z), encoded.w};
    }
    case gpu::Format::Rgba32Float: {
        vec4 value;
        std::memcpy(&value, pixel, sizeof(value));
        return value;
    }
    case gpu::Format::Depth32Float: {
        float value = 0;
        std::memcpy(&value, pixel, sizeof(value));
        return vec4{value};
    }
    default: check(false, "a format that can be read back"); return {};
    }
}

vec3 unitFromOctahedral(vec2 p)
{
    vec3 v{p, 1.0f - std::abs(p.x) - std::abs(p.y)};
    if (v.z < 0.0f)
        v = {(1.0f - std::abs(p.y)) * (p.x >= 0 ? 1.0f : -1.0f), (1.0f - std::abs(p.x)) * (p.y >= 0 ? 1.0f : -1.0f), v.z};
    return glm::normalize(v);
}

} // namespace

std::optional<Aov> aovOf(std::string_view name)
{
    const auto found = std::ranges::find(kAovNames, name);
    if (found == kAovNames.end())
        return std::nullopt;
    return static_cast<Aov>(found - kAovNames.begin());
}

Renderer::Renderer(gpu::Device& device, const scene::Assets& assets, uvec2 extent)
    : device_(&device), scene_(device, assets), blocks_(device, assets), prt_(device), gbuffer_(device), posing_(device), ground_(device),
      occlusion_(device), areaLights_(device, assets), reference_(device), composite_(device), overlay_(device), counters_(device),
      executor_(device), picture_(makePicture(device, extent))
{
}

void Renderer::resize(uvec2 extent)
{
    if (extent != this->extent())
        picture_ = makePicture(*device_, extent);
}

void Renderer::declareCapture(Aov aov, ImageRef image)
{
    if (!isCaptured(aov) || !image)
        return;
    const graph::Resource& resource = graph_.resources()[image.index];
    const uvec2 extent = graph_.extent(image);
    Readback& readback = readbacks_[static_cast<uint32_t>(aov)];
    const size_t bytes = size_t{extent.x} * extent.y * gpu::bytesPerPixel(resource.image.format);
    if (readback.buffer.bytes() != bytes)
        readback.buffer = gpu::Buffer(*device_, "readback", bytes, gpu::MemoryKind::Readback);
    readback.format = resource.image.format;
    readback.extent = extent;

    graph::Pass pass = graph_.add("capture");
    pass.read(image, Use::TransferRead);
    const graph::BufferRef target =
        pass.write(graph_.importBuffer("readback", bytes, graph::importedBuffer(readback.buffer)), Use::TransferWrite);
    pass.record([image, handle = readback.buffer.handle()](graph::Recorder& recorder) { copyToBuffer(recorder, image, handle); });
    graph_.output(target, Use::HostRead);
}

void Renderer::declare(const FrameView& view, const gpu::Image* window)
{
    scene_.prepare(view);
    nearMetres_ = view.camera.nearMetres;
    graph_.reset();
    const uint32_t frame = blocks_.write(view, scene_, prt_.prepare(view.shownBake()), extent());
    graph::BufferRef counters = counters_.declareClear(graph_);

    const Baked baked = prt_.declare(graph_, view, frame, blocks_.newest());
    const FieldFrame fields = gbuffer_.writeFields(view);
    hasLateFields_ = fields.isLate;
    const Posed posed = posing_.declare(graph_, view, scene_, fields);
    const GBuffer g = gbuffer_.declare(graph_, view, frame, scene_, fields, baked, posed, extent(),
                                       {.all = captures_ != 0, .steps = isCaptured(Aov::Steps)});
    const Grounds grounds = ground_.declare(graph_, view, frame, scene_, baked, posed);
    const Traced traced = occlusion_.declare(graph_, view, frame, scene_, fields, baked, grounds, g, posed, counters);
    const ImageRef reference = reference_.declare(graph_, view, frame, scene_, fields, baked, grounds, g, posed);
    const AreaLit lit = areaLights_.declare(graph_, view, frame, scene_, fields, g, posed, counters);
    const ImageRef blank =
        graph_.import("picture", {.format = gpu::Format::Rgba8Unorm, .extent = extent()}, graph::importedImage(picture_), {});
    const Kept kept{.color = isCaptured(Aov::Color),
                    .irradiance = isCaptured(Aov::Irradiance),
                    .occluded = isCaptured(Aov::Occluded) || isCaptured(Aov::Cones)};
    const Composed composed = composite_.declare(graph_, view, frame, scene_, g, traced, reference, lit, blank, kept, counters);
    const ImageRef picture = overlay_.declare(graph_, composed.picture);

    declareCapture(Aov::Color, composed.color);
    declareCapture(Aov::Irradiance, composed.irradiance);
    declareCapture(Aov::Unshadowed, g.unshadowed);
    declareCapture(Aov::Occluded, composed.occluded);
    declareCapture(Aov::Albedo, g.albedo);
    declareCapture(Aov::Normal, g.normals);
    declareCapture(Aov::Depth, g.depth);
    declareCapture(Aov::Cones, composed.occluded);
    declareCapture(Aov::Steps, g.steps);
    counters_.declareReadback(graph_, counters);
    graph_.output(picture, Use::TransferRead);
    if (window != nullptr)
        declarePresent(graph_, picture, *window);
    compile(graph_, plan_);
}

void Renderer::render(const FrameView& view, const gpu::Image* window, VkSemaphore waitFor, VkSemaphore signal)
{
    const VkCommandBuffer commands = device_->beginFrame();
    counters_.beginFrame();
    declare(view, window);
    executor_.execute(plan_, graph_, commands);
    device_->endFrame(waitFor, signal);
    captures_ = 0;
}

void Renderer::capture(std::span<const Aov> aovs)
{
    for (const Aov aov : aovs)
        captures_ |= 1u << static_cast<uint32_t>(aov);
}

scene::Image8 Renderer::picture()
{
    device_->waitIdle();
    const uvec2 extent = this->extent();
    scene::Image8 image{extent.x, extent.y, std::vector<uint8_t>(size_t{4} * extent.x * extent.y)};
    const gpu::Buffer target(*device_, "picture readback", image.rgba.size(), gpu::MemoryKind::Readback);
    device_->submitNow([&](VkCommandBuffer commands) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, .imageExtent = {extent.x, extent.y, 1}};
        vkCmdCopyImageToBuffer(commands, picture_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.handle(), 1, &region);
    });
    std::memcpy(image.rgba.data(), target.mapped(), image.rgba.size());
    return image;
}

scene::ImageF Renderer::captured(Aov aov)
{
    device_->waitIdle();
    const Readback& readback = readbacks_[static_cast<uint32_t>(aov)];
    const uint32_t channels = aov == Aov::Depth || aov == Aov::Cones || aov == Aov::Steps ? 1 : 3;
    if (!readback.buffer) // nothing of the kind in the frame: no character, nothing occluded
        return {extent().x, extent().y, channels, std::vector<float>(size_t{channels} * extent().x * extent().y, 0.0f)};
    scene::ImageF image{readback.extent.x, readback.extent.y, channels, {}};
    const size_t stride = gpu::bytesPerPixel(readback.format);
    for (size_t i = 0; i < size_t{image.width} * image.height; ++i) {
        const vec4 value = unpacked(readback.buffer.mapped() + i * stride, readback.format);
        const vec3 shown = aov == Aov::Normal ? unitFromOctahedral({value.z, value.w}) : vec3(value);
        if (aov == Aov::Depth)
            image.values.push_back(value.x > 0 ? nearMetres_ / value.x : 0.0f);
        else if (aov == Aov::Steps)
            image.values.push_back(value.x);
        else if (aov == Aov::Cones)
            image.values.push_back(value.w);
        else
            image.values.insert(image.values.end(), {shown.x, shown.y, shown.z});
    }
    return image;
}

std::optional<uint32_t> Renderer::referenceSamples() const
{
    const std::optional<uint32_t> environment = reference_.samples(), lights = areaLights_.referenceSamples();
    return environment && lights ? std::min(*environment, *lights) : environment ? environment : lights;
}

FrameReport Renderer::report() const
{
    return {.passes = executor_.passTimes(),
            .absent = plan_.absent,
            .frameMilliseconds = executor_.frameMilliseconds(),
            .counters = counters_.newest(),
            .frame = device_->frameNumber(),
            .hasLateFields = hasLateFields_};
}

MemoryReport Renderer::memory() const
{
    const gpu::MemoryStats& stats = device_->memory().stats();
    return {.reserved = stats.reservedBytes,
            .used = stats.usedBytes,
            .transient = executor_.transientBytes(),
            .history = executor_.historyBytes(),
            .allocationsEver = stats.allocationsEver};
}

} // namespace antumbra::render
