// What the overlay shows: the price of every pass, what was counted, and all knobs. Built anew each frame from what it is given;
// draws nothing itself (render::Overlay does) and reads no keys: it sees the mouse through ImGui's io.
#pragma once

#include "app/profiler.h"
#include "app/quality.h"

#include <span>
#include <string>
#include <string_view>

namespace antumbra::app {

/// A line of the list of keys: "W A S D", "walk".
struct KeyHint
{
    std::string_view key;
    std::string_view what;
};

struct PanelInput
{
    std::string_view device, scene;
    const Profiler& profiler;
    const render::FrameReport& report;
    const render::MemoryReport& memory;
    const QualityControl* quality = nullptr; // where a frame time is to be held
    std::span<const KeyHint> keys;
    std::string_view message; // of what is amiss or under way; shown while it is not empty
};

class Panels
{
public:
    /// Between Overlay::begin and end. Writes `knobs` and `splitColumn` where the mouse asks for it: knobs stay in their range, the
    /// column in the picture. Hidden panels still show the message and still move the split.
    void build(const PanelInput& input, render::Knobs& knobs, uint32_t& splitColumn);

    void toggle() { areVisible_ = !areVisible_; }
    [[nodiscard]] bool areVisible() const { return areVisible_; }

private:
    bool areVisible_ = true;
    std::string graphed_; // pass whose history is drawn; empty: the whole frame
};

} // namespace antumbra::app
