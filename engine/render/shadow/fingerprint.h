// Whether a view is the one of the frame before: what accumulates over frames starts anew where it is not.
#pragma once

#include "render/frame_view.h"

namespace antumbra::render {

/// Of all that the light on what is seen depends on, and of what traces it. Not of how a shadow is found otherwise.
uint64_t fingerprintOf(const FrameView& view, RayBackend backend, uvec2 extent);

} // namespace antumbra::render
