// One frame: from a FrameView to a picture. Owns the render systems and the order they are declared in; knows no World and no window.
#pragma once

#include "graph/executor.h"
#include "render/composite.h"
#include "render/counters.h"
#include "render/gbuffer.h"
#include "render/gpu_scene.h"
#include "render/overlay.h"
#include "render/posing.h"
#include "render/shadow/area_light.h"
#include "render/shadow/ground.h"
#include "render/shadow/occlusion.h"
#include "render/shadow/prt.h"
#include "render/shadow/reference.h"

#include <optional>
#include <string_view>

namespace antumbra::render {

/// What can be read back beside the picture (DESIGN.md, Commands). Units: W/(m^2 sr), W/m^2, metres, cones and steps a pixel.
enum class Aov { Color, Irradiance, Unshadowed, Occluded, Albedo, Normal, Depth, Cones, Steps };
inline constexpr uint32_t kAovCount = 9;

std::optional<Aov> aovOf(std::string_view name);

/// What the newest finished frame did.
struct FrameReport
{
    std::span<const graph::PassTime> passes;   // in order
    std::span<const graph::AbsentPass> absent; // of the newest plan: culled and skipped, with reasons
    std::optional<double> frameMilliseconds;   // first pass to last
    shader::CounterBlock counters;
    uint64_t frame = 0;         // frames finished so far
    bool hasLateFields = false; // FieldFrame::isLate, of the newest frame declared
};

struct MemoryReport
{
    uint64_t reserved = 0, used = 0, transient = 0, history = 0; // bytes
    uint64_t allocationsEver = 0;                                // device ranges handed out since the start
};

class Renderer
{
public:
    Renderer(gpu::Device& device, const scene::Assets& assets, uvec2 extent);

    void resize(uvec2 extent);
    [[nodiscard]] uvec2 extent() const { return picture_.info().extent; }

    /// Declares, compiles and submits one frame. `window` is an acquired swapchain image, or null; then `waitFor` and `signal` are too.
    void render(const FrameView& view, const gpu::Image* window = nullptr, VkSemaphore waitFor = VK_NULL_HANDLE,
                VkSemaphore signal = VK_NULL_HANDLE);

    /// The next frame keeps these; read them with captured() after it.
    void capture(std::span<const Aov> aovs);
    /// Wait for the device. Rows from the top. An AOV that the frame did not make is zero everywhere.
    [[nodiscard]] scene::Image8 picture();
    [[nodiscard]] scene::ImageF captured(Aov aov);

    /// Build the overlay between frames; what it draws goes into the next.
    [[nodiscard]] Overlay& overlay() { return overlay_; }
    [[nodiscard]] FrameReport report() const;
    /// What area light at FrameView::probedPixel was made of in the newest finished frame.
    [[nodiscard]] std::span<const shader::ProbeLine> probeLines() const { return areaLights_.probeLines(); }
    [[nodiscard]] MemoryReport memory() const;
    /// Samples a pixel that every reference of the view has accumulated as it stands; none where nothing accumulates.
    [[nodiscard]] std::optional<uint32_t> referenceSamples() const;
    [[nodiscard]] const graph::FrameGraph& frameGraph() const { return graph_; }
    [[nodiscard]] const graph::Plan& plan() const { return plan_; }

private:
    /// The frame, top to bottom; what the view lacks declares nothing.
    void declare(const FrameView& view, const gpu::Image* window);

    struct Readback
    {
        gpu::Buffer buffer;
        gpu::Format format = gpu::Format::Undefined;
        uvec2 extent{0};
    };

    [[nodiscard]] bool isCaptured(Aov aov) const { return (captures_ >> static_cast<uint32_t>(aov) & 1u) != 0; }
    void declareCapture(Aov aov, graph::ImageRef image);

    gpu::Device* device_;
    GpuScene scene_;
    FrameBlocks blocks_;
    PrtSystem prt_;
    GBufferSystem gbuffer_;
    PosingSystem posing_;
    GroundSystem ground_;
    OcclusionSystem occlusion_;
    AreaLightSystem areaLights_;
    ReferenceSystem reference_;
    CompositeSystem composite_;
    Overlay overlay_;
    Counters counters_;
    graph::FrameGraph graph_;
    graph::Plan plan_;
    graph::Executor executor_;
    gpu::Image picture_;    // Rgba8Unorm, sRGB-encoded
    uint32_t captures_ = 0; // bits of Aov
    float nearMetres_ = 0;  // of the newest frame, for reading depth back
    bool hasLateFields_ = false;
    Readback readbacks_[kAovCount];
};

} // namespace antumbra::render
