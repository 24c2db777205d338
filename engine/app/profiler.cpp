#include "app/profiler.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>

namespace antumbra::app {

SampleWindow::SampleWindow(size_t capacity) : capacity_(capacity)
{
    check(capacity > 0, "a window of at least one value");
    ring_.reserve(capacity);
    sorted_.reserve(capacity);
}

void SampleWindow::push(double value)
{
    check(std::isfinite(value), "a finite sample");
    if (ring_.size() < capacity_) {
        ring_.push_back(value);
    } else {
        sorted_.erase(std::ranges::lower_bound(sorted_, ring_[oldest_]));
        ring_[oldest_] = value;
        oldest_ = (oldest_ + 1) % capacity_;
    }
    sorted_.insert(std::ranges::upper_bound(sorted_, value), value);
}

double SampleWindow::operator[](size_t index) const
{
    check(index < ring_.size(), "a sample within the window");
    return ring_[(oldest_ + index) % ring_.size()];
}

std::optional<double> SampleWindow::median() const
{
    if (sorted_.empty())
        return std::nullopt;
    const size_t count = sorted_.size();
    return (sorted_[(count - 1) / 2] + sorted_[count / 2]) / 2;
}

std::optional<double> SampleWindow::least() const { return sorted_.empty() ? std::nullopt : std::optional(sorted_.front()); }

std::optional<double> SampleWindow::greatest() const { return sorted_.empty() ? std::nullopt : std::optional(sorted_.back()); }

Profiler::Profiler(size_t window) : window_(window), frame_(window), gpu_(window) {}

void Profiler::record(const render::FrameReport& report, std::optional<double> frameMilliseconds)
{
    if (frameMilliseconds)
        frame_.push(*frameMilliseconds);
    if (report.frameMilliseconds)
        gpu_.push(*report.frameMilliseconds);
    ran_ = 0;
    for (const graph::PassTime& time : report.passes) {
        const auto next = passes_.begin() + static_cast<std::ptrdiff_t>(ran_);
        const auto known = std::find_if(next, passes_.end(), [&](const PassTimes& pass) { return pass.name == time.name; });
        if (known == passes_.end()) {
            passes_.insert(next, {std::string(time.name), SampleWindow(window_)});
        } else {
            std::rotate(next, known, known + 1);
        }
        if (time.milliseconds)
            passes_[ran_].milliseconds.push(*time.milliseconds);
        ++ran_;
    }
}

void Profiler::clear()
{
    passes_.clear();
    ran_ = 0;
    frame_ = SampleWindow(window_);
    gpu_ = SampleWindow(window_);
}

} // namespace antumbra::app
