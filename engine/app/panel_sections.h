// The sections that the panels are put together from. For panels.cpp and the sections' own files only.
#pragma once

#include "app/panels.h"

#include <fmt/format.h>
#include <imgui.h>

namespace antumbra::app {

/// One line for ImGui, ended by a zero; what does not fit is cut off. Allocates nothing.
class Line
{
public:
    template <class... Args>
    explicit Line(fmt::format_string<Args...> format, Args&&... args)
    {
        *fmt::format_to_n(text_, sizeof(text_) - 1, format, std::forward<Args>(args)...).out = '\0';
    }

    operator const char*() const { return text_; }

private:
    char text_[160];
};

/// Name on the left, value on the right.
void buildRow(std::string_view name, const char* value, const ImVec4& color);

/// Frame rate, history of the frame or of the pass that was clicked, and a line a pass.
void buildPasses(const PanelInput& input, std::string& graphed);
/// Rays, cones and broken pixels of the newest finished frame; `extent` in pixels.
void buildCounters(const shader::CounterBlock& counters, const render::Knobs& knobs, uvec2 extent);
void buildMemory(const render::MemoryReport& memory);

inline constexpr std::string_view kViewKey = "view"; // the knob with buttons of its own
inline constexpr float kFieldWidth = 104;            // pixels

/// The name of one of the knob's choices; empty for what is none.
std::string_view nameOf(const render::KnobDescription& knob, double value);

/// A button a view, and the column where the picture is split.
void buildViews(render::Knobs& knobs, uint32_t& splitColumn, uint32_t width);
/// Drag with the right button; also draws the line.
void moveSplit(const render::Knobs& knobs, uint32_t& splitColumn, uvec2 extent, bool isLineVisible);

/// A line a knob, but for the view, which has its buttons.
void buildKnobs(render::Knobs& knobs);
/// The allowed value nearest to `value`.
double snapped(const render::KnobRange& range, double value);

} // namespace antumbra::app
