// Characters into their pose: skinning, the bounds of what came out, what rays are traced through. A pose that did not change costs
// nothing; when many change, the oldest go first and the rest wait a frame, wholly: picture and shadow of a character always agree.
#pragma once

#include "graph/executor.h"
#include "render/field_boxes.h"
#include "render/gpu_scene.h"

#include <vector>

namespace antumbra::render {

/// Handles behind which the frame's poses stand; the first two absent without characters.
struct Posed
{
    graph::BufferRef vertices;                   // every character's posed streams
    graph::BufferRef bounds;                     // BlockerBlock[] and CapsuleBlock[] in the world; for an Environment alone
    graph::BufferRef scene;                      // what rays are traced through, where any are: GpuScene::tracedAddress
    graph::Use sceneUse = graph::Use::AccelRead; // by a pass that traces rays through it
};

class PosingSystem
{
public:
    explicit PosingSystem(gpu::Device& device) : device_(&device), fieldBoxes_(device) {}

    Posed declare(graph::FrameGraph& graph, const FrameView& view, GpuScene& scene, const FieldFrame& fields);

private:
    void makePipelines(const FrameView& view, RayBackend backend);
    void choose(const FrameView& view, GpuScene& scene);
    void declareSkinning(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed);
    void declareTriangleBuilds(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed);
    void declareBoxBuilds(graph::FrameGraph& graph, const GpuScene& scene, const FieldFrame& fields, Posed& posed);
    void declareSceneBuild(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed);
    void recordRefits(graph::Recorder& recorder, const FrameView& view, const GpuScene& scene) const;
    void recordAccelScene(graph::Recorder& recorder, const FrameView& view, const GpuScene& scene) const;
    void recordBvhScene(graph::Recorder& recorder, const FrameView& view, const GpuScene& scene) const;
    void declareBounds(graph::FrameGraph& graph, const FrameView& view, const GpuScene& scene, Posed& posed);

    gpu::Device* device_;
    gpu::Pipeline skinning_, boneFit_, sphereFit_, blockers_;
    gpu::Pipeline bvhRefit_, bvhScene_; // compute-bvh
    FieldBoxes fieldBoxes_;             // ray-query
    std::vector<uint32_t> chosen_;      // into FrameView::characters: posed anew this frame
};

} // namespace antumbra::render
