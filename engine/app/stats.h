// The stats JSON (DESIGN.md, Commands): what ran, for how long, and what it counted. Writes no file.
#pragma once

#include "app/profiler.h"
#include "app/quality.h"

#include <string>
#include <string_view>

namespace antumbra::app {

struct StatsInput
{
    std::string_view device, driver, scene;
    uvec2 size;      // pixels
    uint64_t frames; // without the warm-up
    const render::Knobs& knobs;
    const QualityControl* quality = nullptr; // where a frame time is to be held
    const Profiler& profiler;
    const render::FrameReport& report;
    const render::MemoryReport& memory;
};

/// Ends with a newline. Times are milliseconds; one that cannot be had reads null.
std::string statsJson(const StatsInput& input);

} // namespace antumbra::app
