// The surfaces the camera sees: depth, normals, albedo and the first term of their light, by rasterisation.
#pragma once

#include "graph/executor.h"
#include "render/fields.h"
#include "render/frame_blocks.h"
#include "render/gpu_scene.h"
#include "render/posing.h"
#include "render/shadow/prt.h"

#include <array>
#include <tuple>

namespace antumbra::render {

/// All of the picture's extent. Depth is reversed: near / depth is the view depth in metres, 0 where nothing is.
struct GBuffer
{
    graph::ImageRef depth;
    graph::ImageRef normals;    // octahedral: geometric, shading; world
    graph::ImageRef albedo;     // a: 1 for what moves
    graph::ImageRef unshadowed; // first term of the irradiance, W/m^2; a: roughness
    graph::ImageRef material;   // roughness, metallic, specular: where light is reflected by them
    graph::ImageRef steps;      // through distance fields to where they are seen; where they are asked for
};

class GBufferSystem
{
public:
    explicit GBufferSystem(gpu::Device& device) : device_(&device), fields_(device) {}

    /// What is asked for beside what passes read.
    struct Kept
    {
        bool all = false;   // where nothing is, images other than the depth hold zero, else anything
        bool steps = false; // GBuffer::steps
    };
    GBuffer declare(graph::FrameGraph& graph, const FrameView& view, uint32_t frame, const GpuScene& scene, const FieldFrame& fields,
                    const Baked& baked, const Posed& posed, uvec2 extent, Kept kept);
    /// The frame's distance fields; before declare().
    FieldFrame writeFields(const FrameView& view) { return fields_.write(view); }

    /// Whether an area light is reflected by something that is not purely diffuse.
    static bool isGlossy(const FrameView& view, const GpuScene& scene);

private:
    struct Draw
    {
        float depthView; // behind which nothing of it lies, metres; a guess for what deforms
        uint32_t object; // into FrameView::statics, and on into FrameView::characters
        uint32_t cluster;

        [[nodiscard]] auto place() const { return std::tuple(depthView, object, cluster); } // among all
    };

    /// Where an object's first term comes from.
    enum class FirstTerm { Environment, Atlas, Volume, None };
    struct MaterialPipelines
    {
        gpu::Pipeline plain, textured, cutOut;
    };

    static FirstTerm firstTermOf(const FrameView& view, uint32_t object);
    void makePipelines(FirstTerm firstTerm);
    MaterialPipelines& pipelinesOf(FirstTerm firstTerm) { return pipelines_[static_cast<size_t>(firstTerm)][keepsMaterial_ ? 1 : 0]; }
    void listDraws(const FrameView& view, const GpuScene& scene, uvec2 extent);
    [[nodiscard]] const gpu::Pipeline& pipelineFor(FirstTerm firstTerm, const shader::MaterialBlock& material);

    void prepareFields(const FrameView& view, bool keepsSteps);

    gpu::Device* device_;
    Fields fields_;
    std::array<std::array<MaterialPipelines, 2>, 4> pipelines_; // by FirstTerm and whether materials are kept, made when first asked for
    bool keepsMaterial_ = false;                                // of the frame that is declared
    std::vector<Draw> draws_;                                   // of the frame that is declared, nearest first
};

} // namespace antumbra::render
