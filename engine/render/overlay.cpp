#include "render/overlay.h"

#include "base/check.h"
#include "graph/executor.h"
#include "render/overlay_style.h"
#include "render/shader_structs.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace antumbra::render {

namespace {

using shader::OverlayVertex;

static_assert(sizeof(OverlayVertex) == sizeof(ImDrawVert) && offsetof(OverlayVertex, position) == offsetof(ImDrawVert, pos) &&
                  offsetof(OverlayVertex, uv) == offsetof(ImDrawVert, uv) && offsetof(OverlayVertex, color) == offsetof(ImDrawVert, col),
              "the vertex shader reads ImDrawVert as it is");
static_assert(sizeof(ImDrawIdx) == 2, "the vertex shader reads indices of 16 bits");

/// All lists one after the other, in the store of this frame.
struct DrawBytes
{
    VkDeviceAddress vertices;
    VkDeviceAddress indices;
};

template <class T>
std::byte* append(std::byte* target, const ImVector<T>& values)
{
    const auto bytes = static_cast<size_t>(values.size_in_bytes());
    std::memcpy(target, values.Data, bytes);
    return target + bytes;
}

DrawBytes write(gpu::Device& device, const ImDrawData& data)
{
    const gpu::FrameBytes vertices = device.frameBytes(static_cast<size_t>(data.TotalVtxCount) * sizeof(ImDrawVert));
    const gpu::FrameBytes indices = device.frameBytes(static_cast<size_t>(data.TotalIdxCount) * sizeof(ImDrawIdx));
    std::byte* nextVertex = vertices.mapped;
    std::byte* nextIndex = indices.mapped;
    for (const ImDrawList* list : std::span(data.CmdLists, static_cast<size_t>(data.CmdListsCount))) {
        nextVertex = append(nextVertex, list->VtxBuffer);
        nextIndex = append(nextIndex, list->IdxBuffer);
    }
    return {vertices.address, indices.address};
}

/// Empty where the rectangle lies outside of the picture.
VkRect2D scissorOf(const ImVec4& rectangle, uvec2 extent)
{
    const vec2 greatest(extent);
    const ivec2 from(glm::clamp(vec2(rectangle.x, rectangle.y), vec2(0), greatest));
    const ivec2 to(glm::clamp(vec2(rectangle.z, rectangle.w), vec2(from), greatest));
    return {{from.x, from.y}, {static_cast<uint32_t>(to.x - from.x), static_cast<uint32_t>(to.y - from.y)}};
}

void recordDraws(graph::Recorder& cmd, const gpu::Pipeline& pipeline, const ImDrawData& data, shader::OverlayDraw draw, uvec2 extent)
{
    uint32_t firstVertex = 0, firstIndex = 0; // of the list
    for (const ImDrawList* list : std::span(data.CmdLists, static_cast<size_t>(data.CmdListsCount))) {
        for (const ImDrawCmd& command : list->CmdBuffer) {
            check(command.UserCallback == nullptr, "panels without draw callbacks of their own");
            const VkRect2D scissor = scissorOf(command.ClipRect, extent);
            if (scissor.extent.width == 0 || scissor.extent.height == 0)
                continue;
            vkCmdSetScissor(cmd.commands(), 0, 1, &scissor);
            draw.firstVertex = firstVertex + command.VtxOffset;
            draw.firstIndex = firstIndex + command.IdxOffset;
            cmd.draw(pipeline, draw, command.ElemCount);
        }
        firstVertex += static_cast<uint32_t>(list->VtxBuffer.Size);
        firstIndex += static_cast<uint32_t>(list->IdxBuffer.Size);
    }
}

} // namespace

Overlay::Overlay(gpu::Device& device) : device_(&device), context_(ImGui::CreateContext())
{
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendRendererName = "antumbra";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    applyOverlayStyle(ImGui::GetStyle());
}

Overlay::~Overlay() { ImGui::DestroyContext(context_); }

void Overlay::begin(uvec2 extent, float seconds)
{
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    if (!io.Fonts->IsBuilt())
        io.Fonts->Build();
    io.DisplaySize = {static_cast<float>(extent.x), static_cast<float>(extent.y)};
    io.DeltaTime = std::max(seconds, 1e-5f); // ImGui refuses frames that take no time
    ImGui::NewFrame();
}

void Overlay::end()
{
    ImGui::Render();
    isPending_ = ImGui::GetDrawData()->TotalIdxCount > 0;
    if (isPending_ && !pipeline_)
        makeDeviceParts();
}

void Overlay::makeDeviceParts()
{
    unsigned char* texels = nullptr;
    ivec2 extent{0};
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &extent.x, &extent.y);
    const size_t bytes = static_cast<size_t>(extent.x) * static_cast<size_t>(extent.y);
    font_ = gpu::uploadedImage(*device_, "overlay font", {.format = gpu::Format::R8Unorm, .extent = uvec2(extent)},
                               std::as_bytes(std::span(texels, bytes)));

    constexpr gpu::Format picture[] = {gpu::Format::Rgba8Unorm};
    pipeline_ = gpu::rasterPipeline(
        *device_, {.vertexShader = "overlay.vert", .fragmentShader = "overlay.frag", .colorFormats = picture, .blends = true});
}

graph::ImageRef Overlay::declare(graph::FrameGraph& graph, graph::ImageRef picture)
{
    if (!isPending_) {
        graph.skip("overlay", "nothing to show");
        return picture;
    }
    isPending_ = false;
    ImGui::SetCurrentContext(context_);
    const ImDrawData* data = ImGui::GetDrawData();
    const DrawBytes bytes = write(*device_, *data);

    graph::Pass pass = graph.add("overlay");
    const graph::ImageRef drawn = pass.write(picture, graph::Use::ColorAttachment);
    pass.record([=, this](graph::Recorder& cmd) {
        const shader::OverlayDraw draw{.vertices = bytes.vertices,
                                       .indices = bytes.indices,
                                       .extent = {data->DisplaySize.x, data->DisplaySize.y},
                                       .font = font_.sampledSlot()};
        recordDraws(cmd, pipeline_, *data, draw, cmd.extent(drawn));
    });
    return drawn;
}

} // namespace antumbra::render
