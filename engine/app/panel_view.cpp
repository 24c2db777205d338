#include "app/panel_sections.h"
#include "render/overlay_style.h"

#include <algorithm>

namespace antumbra::app {

namespace {

using render::KnobDescription;
using render::Knobs;

const KnobDescription& viewKnob()
{
    static const KnobDescription& knob = *std::ranges::find(render::knobTable(), kViewKey, &KnobDescription::key);
    return knob;
}

/// On the line of the last button where there is room for one more.
void placeButton(const char* name)
{
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(name).x + 2 * style.FramePadding.x;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= right)
        ImGui::SameLine();
}

} // namespace

void buildViews(Knobs& knobs, uint32_t& splitColumn, uint32_t width)
{
    const KnobDescription& view = viewKnob();
    const double shown = view.read(knobs);
    for (const render::KnobChoice& choice : view.choices) {
        const Line name("{}", choice.name);
        if (&choice != &view.choices.front())
            placeButton(name);
        ImGui::PushStyleColor(ImGuiCol_Text, choice.value == shown ? render::kOverlayAccent : render::kOverlayText);
        if (ImGui::Button(name))
            view.write(knobs, choice.value);
        ImGui::PopStyleColor();
    }
    constexpr uint32_t none = 0;
    ImGui::PushItemWidth(kFieldWidth);
    ImGui::SliderScalar("split column", ImGuiDataType_U32, &splitColumn, &none, &width, splitColumn > 0 ? "%u" : "off",
                        ImGuiSliderFlags_AlwaysClamp);
    ImGui::PopItemWidth();
}

void moveSplit(const Knobs& knobs, uint32_t& splitColumn, uvec2 extent, bool isLineVisible)
{
    const ImGuiIO& io = ImGui::GetIO();
    const bool isDragged = ImGui::IsMouseDown(ImGuiMouseButton_Right) && !io.WantCaptureMouse && ImGui::IsMousePosValid();
    if (isDragged)
        splitColumn = static_cast<uint32_t>(std::clamp(io.MousePos.x, 0.0f, static_cast<float>(extent.x)));
    splitColumn = std::min(splitColumn, extent.x);
    if (splitColumn == 0 || !(isLineVisible || isDragged))
        return;
    const float x = static_cast<float>(splitColumn);
    ImDrawList& background = *ImGui::GetBackgroundDrawList();
    background.AddLine({x, 0}, {x, static_cast<float>(extent.y)}, ImGui::GetColorU32(render::kOverlayAccent));
    const Line left("final"), right("{}", nameOf(viewKnob(), viewKnob().read(knobs)));
    background.AddText({x - ImGui::CalcTextSize(left).x - 5, 4}, ImGui::GetColorU32(render::kOverlayText), left);
    background.AddText({x + 6, 4}, ImGui::GetColorU32(render::kOverlayText), right);
}

} // namespace antumbra::app
