// Light of area lights on what is seen, less what stands before them: in closed form (KT, Sakurikar, Narayanan 2021, as corrected in
// methods/area-shadows.md), by shadow rays, or accumulated to the truth. The approximations are the tables of linearly transformed cosines
// (bake/ltc.h), which the traced methods do without, and bodies in place of meshes (app/shadow_bodies.h), which they do not need.
#pragma once

#include "render/gbuffer.h"
#include "render/shadow/area_bodies.h"
#include "render/shadow/area_probe.h"
#include "render/shadow/sdf.h"

#include <array>
#include <deque>
#include <optional>

namespace antumbra::render {

/// Absent without area lights.
struct AreaLit
{
    graph::ImageRef diffuse;  // W/m^2, cosine-weighted, without what metal swallows
    graph::ImageRef specular; // W/(m^2 sr) towards the eye; absent where nothing reflects so
};

class AreaLightSystem
{
public:
    AreaLightSystem(gpu::Device& device, const scene::Assets& assets)
        : device_(&device), bodies_(device, assets), probe_(device), fieldShadows_(device)
    {
    }

    AreaLit declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const FieldFrame& fields,
                    const GBuffer& g, const Posed& posed, graph::BufferRef& counters);
    /// Points a light and pixel that the reference has accumulated for the view as it stands; none where no light is shadowed by it.
    [[nodiscard]] std::optional<uint32_t> referenceSamples() const;
    /// Of FrameView::probedPixel.
    [[nodiscard]] std::span<const shader::ProbeLine> probeLines() const { return probe_.lines(); }

private:
    /// What a pipeline is made for.
    struct Variant
    {
        scene::LightShadow shadow;
        bool isGlossy;
        RayBackend backend;
        AreaSizes sizes; // the least for what traces rays, which does not depend on them

        friend bool operator==(const Variant&, const Variant&) = default;
    };
    struct Made
    {
        Variant variant;
        gpu::Pipeline pipeline;
    };
    /// The frame's, as its passes share it.
    struct Frame
    {
        const FrameView* view;
        const GpuScene* scene;
        const GBuffer* g;
        const Posed* posed;
        VkDeviceAddress area;
        graph::BufferRef tiles;
        graph::BufferRef seenPastFields;
        uint32_t slot; // of the FrameBlock
        Scale scale;
        bool isGlossy;
    };

    void skipAll(graph::FrameGraph& graph);
    const gpu::Pipeline& pipelineFor(const Variant& variant);
    void prepareTables(bool isGlossy);
    graph::BufferRef declareTiles(graph::FrameGraph& graph, const Frame& frame, uvec2 tileCount);
    AreaLit declareReference(graph::FrameGraph& graph, const Frame& frame, const AreaLightRange& range, graph::BufferRef& counters);
    AreaLit declareLights(graph::FrameGraph& graph, const Frame& frame, const AreaLightRange& range, const AreaLit& before,
                          graph::BufferRef& counters);
    void declareShade(graph::Pass& pass, const Frame& frame, const AreaLightRange& range, const AreaLit& before, const AreaLit& made,
                      graph::BufferRef counters, uint32_t rays, uint32_t frameIndex, uint32_t scale);
    AreaLit declareUpsample(graph::FrameGraph& graph, const Frame& frame, const AreaLit& lit);

    gpu::Device* device_;
    AreaBodies bodies_;
    AreaProbeSystem probe_;
    FieldShadowSystem fieldShadows_;
    std::deque<Made> pipelines_; // each made when first asked for; passes hold on to those made before
    gpu::Pipeline tiles_;
    std::array<gpu::Pipeline, 2> upsample_; // by whether glossy
    gpu::Image ltcMatrix_, ltcAmplitude_;   // only while something glossy is lit
    graph::HistorySlot diffuseHistory_, specularHistory_;
    uint64_t seen_ = 0;
    uint32_t referenceFrames_ = 0;
    bool hasReference_ = false;
};

} // namespace antumbra::render
