// Light of area lights on what is seen, less what stands before them: in closed form (KT, Sakurikar, Narayanan 2021, as corrected in
// methods/area-shadows.md), by shadow rays, accumulated to the truth, or by shares that others find. The approximations are the tables of
// linearly transformed cosines (bake/ltc.h), which the traced methods do without, and bodies in place of meshes (app/shadow_bodies.h),
// which they do not need.
#pragma once

#include "render/shadow/area_pipelines.h"
#include "render/shadow/area_probe.h"
#include "render/shadow/penumbra.h"
#include "render/shadow/ratio_shadow.h"
#include "render/shadow/sdf.h"

#include <array>
#include <optional>

namespace antumbra::render {

/// Absent without area lights.
struct AreaLit
{
    static constexpr gpu::Format kFormat = gpu::Format::Rgba16Float;

    graph::ImageRef diffuse;  // W/m^2, cosine-weighted, without what metal swallows
    graph::ImageRef specular; // W/(m^2 sr) towards the eye; absent where nothing reflects so
    uint32_t pixelScale = 1;  // of the images to the G-buffer: 1, 2, 4
};

class AreaLightSystem
{
public:
    AreaLightSystem(gpu::Device& device, const scene::Assets& assets)
        : device_(&device), bodies_(device, assets), pipelines_(device), probe_(device), ratioShadows_(device), penumbras_(device)
    {
    }

    AreaLit declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const FieldFrame& fields,
                    const GBuffer& g, const Posed& posed, graph::BufferRef& counters);
    /// Points a light and pixel that the reference has accumulated for the view as it stands; none where no light is shadowed by it.
    [[nodiscard]] std::optional<uint32_t> referenceSamples() const;
    /// Of FrameView::probedPixel.
    [[nodiscard]] std::span<const shader::ProbeLine> probeLines() const { return probe_.lines(); }

private:
    /// What one pass of lights is made of.
    struct Shading
    {
        AreaLit before;          // what it adds to, or the mean so far
        AreaLit made;            // written
        graph::BufferRef shares; // of the range's lights, where these are found apart
        uint32_t rays = 0;       // a light; the reference: 0 keeps the means
        uint32_t frameIndex = 0; // of the reference's accumulation
    };

    void skipAll(graph::FrameGraph& graph);
    void prepareTables(bool isGlossy);
    void declareTiles(graph::FrameGraph& graph, const LitFrame& frame, uvec2 tileCount);
    AreaLit declareReference(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range, graph::BufferRef& counters);
    AreaLit declareLights(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range, const AreaLit& before,
                          graph::BufferRef& counters);
    graph::BufferRef declareShares(graph::FrameGraph& graph, const LitFrame& frame, const AreaLightRange& range);
    void declareShade(graph::Pass& pass, const LitFrame& frame, const AreaLightRange& range, const Shading& shading,
                      graph::BufferRef counters);

    gpu::Device* device_;
    AreaBodies bodies_;
    AreaPipelines pipelines_;
    AreaProbeSystem probe_;
    RatioShadowSystem ratioShadows_;
    PenumbraSystem penumbras_;
    graph::BufferRef occluderTiles_, seenPastFields_; // of the frame that is declared
    gpu::Pipeline tiles_;
    gpu::Image ltcMatrix_, ltcAmplitude_; // only while something glossy is lit
    graph::HistorySlot diffuseHistory_, specularHistory_;
    uint64_t seen_ = 0;
    uint32_t referenceFrames_ = 0;
    bool hasReference_ = false;
};

} // namespace antumbra::render
