#include "render/tonemap.h"

#include "render/shader_structs.h"

namespace antumbra::render {

TonemapSystem::TonemapSystem(gpu::Device& device) : pipeline_(computePipeline(device, "tonemap.comp")) {}

graph::ImageRef TonemapSystem::declare(graph::FrameGraph& graph, const FrameView& view, graph::ImageRef color,
                                       graph::ImageRef picture) const
{
    graph::Pass pass = graph.add("tone map");
    pass.read(color, graph::Use::Sampled);
    const graph::ImageRef written = pass.write(picture, graph::Use::StorageWrite);
    pass.record([this, color, written, exposure = view.exposure](graph::Recorder& recorder) {
        recorder.dispatch(pipeline_,
                          shader::Tonemap{.color = recorder.sampled(color), .picture = recorder.storage(written), .exposure = exposure},
                          recorder.extent(written));
    });
    return written;
}

} // namespace antumbra::render
