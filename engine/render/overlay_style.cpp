#include "render/overlay_style.h"

#include <initializer_list>

namespace antumbra::render {

namespace {

const ImVec4 kGround{0.055f, 0.060f, 0.070f, 0.86f};
const ImVec4 kField{0.145f, 0.155f, 0.175f, 0.90f};
const ImVec4 kFieldHovered{0.205f, 0.220f, 0.245f, 0.95f};
const ImVec4 kFieldActive{0.265f, 0.280f, 0.310f, 1.00f};
const ImVec4 kNothing{0, 0, 0, 0};

void setColors(ImGuiStyle& style)
{
    ImGui::StyleColorsDark(&style);
    ImVec4* const colors = style.Colors;
    colors[ImGuiCol_Text] = kOverlayText;
    colors[ImGuiCol_TextDisabled] = kOverlayQuiet;
    colors[ImGuiCol_WindowBg] = kGround;
    colors[ImGuiCol_PopupBg] = {kGround.x, kGround.y, kGround.z, 0.97f};
    colors[ImGuiCol_Border] = kNothing;
    for (const int field : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_Header})
        colors[field] = kField;
    for (const int field : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered})
        colors[field] = kFieldHovered;
    for (const int field : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive})
        colors[field] = kFieldActive;
    for (const int mark : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_PlotLines, ImGuiCol_CheckMark})
        colors[mark] = kOverlayAccent;
    colors[ImGuiCol_PlotLinesHovered] = kOverlayText;
    colors[ImGuiCol_ScrollbarBg] = kNothing;
    colors[ImGuiCol_ScrollbarGrab] = kFieldHovered;
}

void setMeasures(ImGuiStyle& style)
{
    style.WindowPadding = {8, 6};
    style.FramePadding = {5, 1};
    style.ItemSpacing = {5, 3};
    style.ItemInnerSpacing = {5, 3};
    style.CellPadding = {2, 1};
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 0;
    style.WindowRounding = 4;
    style.PopupRounding = 3;
    style.FrameRounding = 2;
    style.GrabRounding = 2;
    style.GrabMinSize = 7;
    style.ScrollbarSize = 8;
    style.AntiAliasedLinesUseTex = false; // needs filtered texels, which the fragment shader does without
}

} // namespace

void applyOverlayStyle(ImGuiStyle& style)
{
    setColors(style);
    setMeasures(style);
}

} // namespace antumbra::render
