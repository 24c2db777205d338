// One dispatch and its results at once, for tools and tests. Frames go through the graph instead.
#pragma once

#include "base/check.h"
#include "gpu/buffer.h"
#include "gpu/pipeline.h"

namespace antumbra::gpu {

/// At least `threads` threads in groups of `groupSize` along x, as a frame of its own; returns when what it wrote is there for the host.
/// `push` holds at most 128 bytes.
void dispatchNow(Device& device, const Pipeline& pipeline, std::span<const std::byte> push, uint32_t threads, uint32_t groupSize = 64);

template <class Push>
void dispatchNow(Device& device, const Pipeline& pipeline, const Push& push, uint32_t threads)
{
    dispatchNow(device, pipeline, std::as_bytes(std::span(&push, 1)), threads);
}

/// The first `count` values of a buffer that the host sees.
template <class T>
std::span<T> mappedValues(const Buffer& buffer, size_t count)
{
    check(buffer.mapped() != nullptr && count * sizeof(T) <= buffer.bytes(), "a mapped buffer of that many values");
    return {reinterpret_cast<T*>(buffer.mapped()), count};
}

} // namespace antumbra::gpu
