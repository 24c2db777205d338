// GPU times of named spans, read back when their frame is done. A time that cannot be had is absent, never zero.
#pragma once

#include "gpu/device.h"

#include <optional>

namespace antumbra::gpu {

class Timers
{
public:
    static constexpr uint32_t kMostSpans = 64;

    explicit Timers(Device& device);
    ~Timers();
    Timers(const Timers&) = delete;
    Timers& operator=(const Timers&) = delete;

    /// Opens the frame's slot, whose last frame must be done: after Device::beginFrame. Makes that frame's times readable.
    void beginFrame();
    /// Spans are numbered in the order they begin.
    void begin(VkCommandBuffer commands);
    void end(VkCommandBuffer commands);

    /// Milliseconds of span `index` of the newest frame that is done; none without timestamps.
    [[nodiscard]] std::optional<double> milliseconds(uint32_t index) const;
    /// From the start of the first span to the end of the last.
    [[nodiscard]] std::optional<double> wholeMilliseconds() const;

private:
    [[nodiscard]] double between(uint32_t firstQuery, uint32_t lastQuery) const;

    Device& device_;
    VkQueryPool pools_[kFramesInFlight]{};
    uint32_t spans_[kFramesInFlight]{};
    uint64_t ticks_[2 * kMostSpans]{};
    uint32_t doneSpans_ = 0;
};

} // namespace antumbra::gpu
