// Runs one function of tests/gpu/*.comp over many inputs: struct in, struct out, laid out alike in C++ and in the kernel (scalar).
#pragma once

#include "gpu/dispatch.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace antumbra {

struct KernelPush
{
    uint64_t inputs;
    uint64_t outputs;
    uint32_t count;
};

/// `file` under tests/gpu, compiled with `define`. Outputs are filled with 0xff bytes, NaN as floats, before the kernel runs.
template <class Out, class In>
std::vector<Out> runKernel(gpu::Device& device, std::string_view file, std::string_view define, const std::vector<In>& inputs)
{
    const gpu::ShaderDefine defines[]{{define}};
    const gpu::Pipeline pipeline = gpu::computePipeline(device, (projectPath("tests") / "gpu" / file).string(), defines);
    const gpu::Buffer in = gpu::uploadedBuffer(device, "inputs", std::span<const In>(inputs));
    const gpu::Buffer out(device, "outputs", inputs.size() * sizeof(Out), gpu::MemoryKind::Readback);
    std::ranges::fill(gpu::mappedValues<std::byte>(out, out.bytes()), std::byte{0xff});
    const auto count = static_cast<uint32_t>(inputs.size());
    dispatchNow(device, pipeline, KernelPush{in.address(), out.address(), count}, count);
    const std::span<const Out> values = gpu::mappedValues<const Out>(out, inputs.size());
    return {values.begin(), values.end()};
}

} // namespace antumbra
