// How the overlay looks: the one place for its colours and measures.
#pragma once

#include <imgui.h>

namespace antumbra::render {

// sRGB-encoded, as all of ImGui's colours.
inline const ImVec4 kOverlayText{0.88f, 0.89f, 0.91f, 1.00f};
inline const ImVec4 kOverlayQuiet{0.50f, 0.52f, 0.56f, 1.00f};
inline const ImVec4 kOverlayAccent{0.95f, 0.73f, 0.38f, 1.00f};
inline const ImVec4 kOverlayBroken{1.00f, 0.38f, 0.34f, 1.00f};
inline const ImVec4 kOverlayBar{0.95f, 0.73f, 0.38f, 0.20f}; // behind text

void applyOverlayStyle(ImGuiStyle& style);

} // namespace antumbra::render
