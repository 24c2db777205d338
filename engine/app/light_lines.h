// The closed form of area lights at one pixel, drawn over the picture: lights, silhouettes before them, and what is left.
#pragma once

#include "render/frame_view.h"
#include "render/shader_structs.h"

#include <span>

namespace antumbra::app {

/// Between Overlay::begin and end, for a picture of `extent` pixels.
void drawLightLines(std::span<const shader::ProbeLine> lines, const render::CameraView& camera, uvec2 extent);

} // namespace antumbra::app
