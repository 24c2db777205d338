#include "app/light_lines.h"

#include "render/frame_blocks.h"
#include "render/overlay_style.h"

#include <optional>
#include <utility>

namespace antumbra::app {

namespace {

struct Stroke
{
    ImVec4 color;
    float width; // pixels
};

Stroke strokeOf(uint32_t kind)
{
    switch (kind) {
    case shader::kProbeLight: return {render::kOverlayText, 1};
    case shader::kProbeSilhouette: return {render::kOverlayBroken, 1};
    default: return {render::kOverlayAccent, 2};
    }
}

/// What of a line is before the near plane; clip space.
std::optional<std::pair<vec4, vec4>> inFront(vec4 start, vec4 end, float nearMetres)
{
    if (start.w < nearMetres && end.w < nearMetres)
        return std::nullopt;
    const float share = (nearMetres - start.w) / (end.w - start.w);
    if (start.w < nearMetres)
        start = glm::mix(start, end, share);
    else if (end.w < nearMetres)
        end = glm::mix(start, end, share);
    return std::pair(start, end);
}

} // namespace

void drawLightLines(std::span<const shader::ProbeLine> lines, const render::CameraView& camera, uvec2 extent)
{
    const mat4 clipFromWorld = render::clipFromWorld(camera, extent);
    const auto place = [&](const vec4& clip) {
        const vec2 at = (vec2(clip) / clip.w * 0.5f + 0.5f) * vec2(extent);
        return ImVec2{at.x, at.y};
    };
    ImDrawList& background = *ImGui::GetBackgroundDrawList();
    for (const shader::ProbeLine& line : lines) {
        const auto seen = inFront(clipFromWorld * vec4(line.start, 1), clipFromWorld * vec4(line.end, 1), camera.nearMetres);
        const Stroke stroke = strokeOf(line.kind);
        if (seen)
            background.AddLine(place(seen->first), place(seen->second), ImGui::GetColorU32(stroke.color), stroke.width);
    }
}

} // namespace antumbra::app
