// The surfaces the camera sees: depth, normals, albedo and the first term of their light, by rasterisation.
#pragma once

#include "graph/executor.h"
#include "render/frame_blocks.h"
#include "render/gpu_scene.h"
#include "render/posing.h"
#include "render/shadow/prt.h"

#include <array>

namespace antumbra::render {

/// All of the picture's extent. Depth is reversed: near / depth is the view depth in metres, 0 where nothing is.
struct GBuffer
{
    graph::ImageRef depth;
    graph::ImageRef normals;    // octahedral: geometric, shading; world
    graph::ImageRef albedo;     // a: 1 for what moves
    graph::ImageRef unshadowed; // first term of the irradiance, W/m^2; a: roughness
};

class GBufferSystem
{
public:
    explicit GBufferSystem(gpu::Device& device) : device_(&device) {}

    /// Where nothing is, images other than the depth hold zero if they are kept, else anything.
    GBuffer declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const Baked& baked,
                    const Posed& posed, uvec2 extent, bool isKept);

private:
    struct Draw
    {
        float depthView; // behind which nothing of it lies, metres; a guess for what deforms
        uint32_t object; // into FrameView::statics, and on into FrameView::characters
        uint32_t cluster;

        friend auto operator<=>(const Draw&, const Draw&) = default;
    };

    /// Where an object's first term comes from.
    enum class FirstTerm { Environment, Atlas, Volume };
    struct MaterialPipelines
    {
        gpu::Pipeline plain, textured, cutOut;
    };

    static FirstTerm firstTermOf(const FrameView& view, uint32_t object);
    void makePipelines(FirstTerm firstTerm);
    void listDraws(const FrameView& view, const GpuScene& scene, uvec2 extent);
    [[nodiscard]] const gpu::Pipeline& pipelineFor(FirstTerm firstTerm, const shader::MaterialBlock& material) const;

    gpu::Device* device_;
    std::array<MaterialPipelines, 3> pipelines_; // by FirstTerm, each made when first asked for
    std::vector<Draw> draws_;                    // of the frame that is declared, nearest first
};

} // namespace antumbra::render
