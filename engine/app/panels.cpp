#include "app/panels.h"

#include "app/panel_sections.h"
#include "render/overlay_style.h"

namespace antumbra::app {

namespace {

constexpr float kMargin = 8; // pixels, as all below
constexpr float kPassesWidth = 208;
constexpr float kControlsWidth = 262;
constexpr float kWidePicture = 960; // from here on all sections start open
constexpr ImGuiWindowFlags kPinned = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoFocusOnAppearing;

/// As high as what is in it, at most as high as the picture.
void beginColumn(const char* name, float left, float width)
{
    ImGui::SetNextWindowPos({left, kMargin});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, ImGui::GetIO().DisplaySize.y - 2 * kMargin});
    ImGui::Begin(name, nullptr, kPinned);
}

void buildMessage(std::string_view message)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x / 2, size.y - kMargin}, ImGuiCond_Always, {0.5f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x - 2 * kMargin, size.y});
    ImGui::Begin("message", nullptr, kPinned | ImGuiWindowFlags_NoInputs);
    ImGui::PushTextWrapPos(size.x - 4 * kMargin);
    ImGui::PushStyleColor(ImGuiCol_Text, render::kOverlayBroken);
    ImGui::TextUnformatted(message.data(), message.data() + message.size());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::End();
}

void buildKeys(std::span<const KeyHint> keys)
{
    for (const KeyHint& hint : keys)
        buildRow(hint.what, Line("{}", hint.key), render::kOverlayAccent);
}

void buildControls(const PanelInput& input, render::Knobs& knobs, uint32_t& splitColumn, uvec2 extent)
{
    const bool isWide = static_cast<float>(extent.x) >= kWidePicture;
    const auto isOpen = [](const char* title, bool atFirst) {
        ImGui::SetNextItemOpen(atFirst, ImGuiCond_Once);
        return ImGui::CollapsingHeader(title);
    };
    if (isOpen("view", true))
        buildViews(knobs, splitColumn, extent.x);
    if (isOpen("knobs", isWide))
        buildKnobs(knobs);
    if (isOpen("counters", isWide))
        buildCounters(input.report.counters, knobs, extent);
    if (isOpen("memory", isWide))
        buildMemory(input.memory);
    if (!input.keys.empty() && isOpen("keys", isWide))
        buildKeys(input.keys);
}

} // namespace

void buildRow(std::string_view name, const char* value, const ImVec4& color)
{
    ImGui::TextUnformatted(name.data(), name.data() + name.size());
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value).x);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(value);
    ImGui::PopStyleColor();
}

void Panels::build(const PanelInput& input, render::Knobs& knobs, uint32_t& splitColumn)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const uvec2 extent(size.x, size.y);
    moveSplit(knobs, splitColumn, extent, areVisible_);
    if (areVisible_) {
        beginColumn("passes", kMargin, kPassesWidth);
        buildPasses(input, graphed_);
        ImGui::End();
        beginColumn("controls", size.x - kControlsWidth - kMargin, kControlsWidth);
        buildControls(input, knobs, splitColumn, extent);
        ImGui::End();
    }
    if (!input.message.empty())
        buildMessage(input.message);
}

} // namespace antumbra::app
