#include "render/counters.h"

#include <cstring>

namespace antumbra::render {

Counters::Counters(gpu::Device& device) : device_(&device), counters_(device, "counters", sizeof(shader::CounterBlock))
{
    for (gpu::Buffer& readback : readbacks_) {
        readback = gpu::Buffer(device, "counters readback", sizeof(shader::CounterBlock), gpu::MemoryKind::Readback);
        std::memset(readback.mapped(), 0, sizeof(shader::CounterBlock));
    }
}

void Counters::beginFrame() { std::memcpy(&newest_, readbacks_[device_->frameSlot()].mapped(), sizeof(newest_)); }

graph::BufferRef Counters::declareClear(graph::FrameGraph& graph)
{
    graph::Pass pass = graph.add("counters clear");
    const graph::BufferRef cleared = pass.write(
        graph.importBuffer("counters", sizeof(shader::CounterBlock), graph::importedBuffer(counters_)), graph::Use::TransferWrite);
    pass.record([cleared, buffer = counters_.handle()](graph::Recorder& recorder) {
        vkCmdFillBuffer(recorder.commands(), buffer, 0, sizeof(shader::CounterBlock), 0);
    });
    return cleared;
}

void Counters::declareReadback(graph::FrameGraph& graph, graph::BufferRef counters)
{
    graph::Pass pass = graph.add("counters readback");
    pass.read(counters, graph::Use::TransferRead);
    const gpu::Buffer& readback = readbacks_[device_->frameSlot()];
    const graph::BufferRef copied = pass.write(
        graph.importBuffer("counters readback", sizeof(shader::CounterBlock), graph::importedBuffer(readback)), graph::Use::TransferWrite);
    pass.record([from = counters_.handle(), to = readback.handle()](graph::Recorder& recorder) {
        const VkBufferCopy whole{0, 0, sizeof(shader::CounterBlock)};
        vkCmdCopyBuffer(recorder.commands(), from, to, 1, &whole);
    });
    graph.output(copied, graph::Use::HostRead);
}

} // namespace antumbra::render
