#include "app/panel_sections.h"

#include <algorithm>
#include <cmath>

namespace antumbra::app {

namespace {

using render::KnobDescription;
using render::Knobs;

constexpr double kMostLinearSteps = 256; // what a linear slider still resolves

void buildChoices(const KnobDescription& knob, Knobs& knobs)
{
    const double value = knob.read(knobs);
    if (!ImGui::BeginCombo(Line("{}", knob.key), Line("{}", nameOf(knob, value))))
        return;
    for (const render::KnobChoice& choice : knob.choices)
        if (ImGui::Selectable(Line("{}", choice.name), choice.value == value))
            knob.write(knobs, choice.value);
    ImGui::EndCombo();
}

void buildNumber(const KnobDescription& knob, Knobs& knobs)
{
    const auto& [least, greatest, step] = knob.range;
    double value = knob.read(knobs);
    const bool isLinear = step > 0 && (greatest - least) / step <= kMostLinearSteps;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (isLinear ? 0 : ImGuiSliderFlags_Logarithmic);
    if (ImGui::SliderScalar(Line("{}", knob.key), ImGuiDataType_Double, &value, &least, &greatest, step > 0 ? "%.0f" : "%.4f", flags))
        knob.write(knobs, snapped(knob.range, value));
}

void explain(const KnobDescription& knob)
{
    if (!ImGui::IsItemHovered())
        return;
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(knob.doc.data(), knob.doc.data() + knob.doc.size());
    ImGui::TextDisabled("%s", render::allowedValues(knob).c_str());
    ImGui::EndTooltip();
}

} // namespace

std::string_view nameOf(const KnobDescription& knob, double value)
{
    const auto found = std::ranges::find(knob.choices, value, &render::KnobChoice::value);
    return found != knob.choices.end() ? found->name : std::string_view();
}

double snapped(const render::KnobRange& range, double value)
{
    const double inside = std::clamp(value, range.least, range.greatest);
    if (range.step == 0)
        return inside;
    const double steps = std::round((inside - range.least) / range.step);
    return range.least + range.step * std::min(steps, std::floor((range.greatest - range.least) / range.step));
}

void buildKnobs(Knobs& knobs)
{
    ImGui::PushItemWidth(kFieldWidth);
    for (const KnobDescription& knob : render::knobTable()) {
        if (knob.key == kViewKey || !knob.isLive)
            continue;
        if (knob.choices.empty())
            buildNumber(knob, knobs);
        else
            buildChoices(knob, knobs);
        explain(knob);
    }
    ImGui::PopItemWidth();
}

} // namespace antumbra::app
