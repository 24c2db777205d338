#include "app/panel_sections.h"
#include "render/overlay_style.h"

#include <algorithm>

namespace antumbra::app {

namespace {

constexpr float kHistoryHeight = 40; // pixels

void buildHistory(const SampleWindow& times, const char* title)
{
    struct Plotted
    {
        const SampleWindow* times;
    } plotted{&times};
    const auto at = [](void* data, int i) { return static_cast<float>((*static_cast<Plotted*>(data)->times)[static_cast<size_t>(i)]); };
    const float greatest = static_cast<float>(1.25 * times.greatest().value_or(1.0)); // leaves room for the title
    ImGui::PlotLines("##history", at, &plotted, static_cast<int>(times.size()), 0, title, 0.0f, greatest,
                     {ImGui::GetContentRegionAvail().x, kHistoryHeight});
}

void buildQuiet(const char* text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, render::kOverlayQuiet);
    ImGui::TextWrapped("%s", text);
    ImGui::PopStyleColor();
}

void buildHeadline(const PanelInput& input)
{
    buildRow("scene", Line("{}", input.scene), render::kOverlayAccent);
    buildQuiet(Line("{}", input.device));
    const std::optional<double> frame = input.profiler.frameMilliseconds().median();
    buildRow("frame", frame ? Line("{:.2f} ms  {:.0f} fps", *frame, 1000 / *frame) : Line("-"), render::kOverlayText);
    const std::optional<double> gpu = input.profiler.gpuMilliseconds().median();
    if (const QualityControl* quality = input.quality)
        buildRow("target", Line("{:.4g} ms  quality -{} of {}", quality->targetMilliseconds(), quality->level(), quality->lowestLevel()),
                 quality->isTargetHeld() ? render::kOverlayText : render::kOverlayBroken);
    buildRow("passes", gpu ? Line("{:.2f} ms", *gpu) : Line("no timestamps"), render::kOverlayText);
}

/// Behind the line that comes next: how much of the frame the pass takes.
void drawBar(double share)
{
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float length = static_cast<float>(std::min(share, 1.0)) * ImGui::GetContentRegionAvail().x;
    ImGui::GetWindowDrawList()->AddRectFilled(from, {from.x + length, from.y + ImGui::GetTextLineHeight()},
                                              ImGui::GetColorU32(render::kOverlayBar));
}

/// True when it was clicked.
bool buildPass(const PassTimes& pass, std::optional<double> frame, bool isGraphed)
{
    const std::optional<double> median = pass.milliseconds.median();
    if (median && frame && *frame > 0)
        drawBar(*median / *frame);
    const ImVec2 place = ImGui::GetCursorPos();
    const bool isClicked = ImGui::Selectable("##pass", isGraphed);
    ImGui::SetCursorPos(place);
    buildRow(pass.name, median ? Line("{:.3f}", *median) : Line("-"), render::kOverlayText);
    return isClicked;
}

void buildAbsent(const graph::AbsentPass& pass)
{
    // As reasonOf() says it, without its string.
    const Line line = !pass.reason.empty()  ? Line("{}: {}", pass.name, pass.reason)
                      : pass.unread.empty() ? Line("{}: it writes nothing", pass.name)
                                            : Line("{}: nothing reads '{}'", pass.name, pass.unread);
    buildQuiet(line);
}

const SampleWindow* timesOf(const Profiler& profiler, std::string_view name)
{
    const auto found = std::ranges::find(profiler.passes(), name, &PassTimes::name);
    return found != profiler.passes().end() ? &found->milliseconds : nullptr;
}

} // namespace

void buildPasses(const PanelInput& input, std::string& graphed)
{
    buildHeadline(input);
    const SampleWindow* times = timesOf(input.profiler, graphed);
    if (times != nullptr)
        buildHistory(*times, graphed.c_str());
    else
        buildHistory(input.profiler.frameMilliseconds(), "frame");

    const std::optional<double> frame = input.profiler.gpuMilliseconds().median();
    int row = 0;
    for (const PassTimes& pass : input.profiler.passes()) {
        ImGui::PushID(row++);
        const bool isGraphed = pass.name == graphed;
        if (buildPass(pass, frame, isGraphed))
            graphed = isGraphed ? std::string() : pass.name;
        ImGui::PopID();
    }
    for (const graph::AbsentPass& pass : input.report.absent)
        buildAbsent(pass);
}

} // namespace antumbra::app
