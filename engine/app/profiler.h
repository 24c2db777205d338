// What passes and frames cost: their newest times in sliding windows, ready for medians. Measures nothing itself: it is told.
#pragma once

#include "render/renderer.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace antumbra::app {

/// The newest values, up to a fixed number of them. Allocates when made, never after.
class SampleWindow
{
public:
    explicit SampleWindow(size_t capacity);

    /// Finite. Drops the oldest value of a full window.
    void push(double value);

    [[nodiscard]] size_t size() const { return sorted_.size(); }
    /// 0 is the oldest.
    [[nodiscard]] double operator[](size_t index) const;

    /// All are absent while there are no values. Of an even number of values the median is the mean of the two in the middle.
    [[nodiscard]] std::optional<double> median() const;
    [[nodiscard]] std::optional<double> least() const;
    [[nodiscard]] std::optional<double> greatest() const;

private:
    size_t capacity_;
    std::vector<double> ring_;
    std::vector<double> sorted_;
    size_t oldest_ = 0;
};

/// Times of one pass. Without timestamps on the device it stays empty.
struct PassTimes
{
    std::string name;
    SampleWindow milliseconds;
};

class Profiler
{
public:
    static constexpr size_t kShownFrames = 64;

    /// Statistics are over the newest `window` frames. Where the same passes come again, it allocates nothing.
    explicit Profiler(size_t window = kShownFrames);

    /// Once a frame. `frameMilliseconds` is the time of the whole frame by the caller's clock.
    void record(const render::FrameReport& report, std::optional<double> frameMilliseconds);
    /// Forgets all times: the frames so far were warm-up.
    void clear();

    /// Those of the newest frame, in its order. A name that a frame has twice is here twice.
    [[nodiscard]] std::span<const PassTimes> passes() const { return std::span(passes_).first(ran_); }
    [[nodiscard]] const SampleWindow& frameMilliseconds() const { return frame_; }
    /// On the device, from the first pass to the last.
    [[nodiscard]] const SampleWindow& gpuMilliseconds() const { return gpu_; }

private:
    size_t window_;
    std::vector<PassTimes> passes_; // those that ran in the newest frame, then those that ran before
    size_t ran_ = 0;
    SampleWindow frame_;
    SampleWindow gpu_;
};

} // namespace antumbra::app
