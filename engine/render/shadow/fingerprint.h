// What references that accumulate over frames share: how many samples, and whether a view is the one of the frame before, as they start
// anew where it is not.
#pragma once

#include "render/frame_view.h"

namespace antumbra::render {

inline constexpr uint32_t kSamplesAFrame = 64; // small enough to keep a live view usable
inline constexpr uint32_t kLiveSamples = 4096; // where a view asks for the reference and no number is set

/// Of all that the light on what is seen depends on, and of what traces it: late fields (FieldFrame::isLate) are others than the view's.
/// Not of how a shadow is found otherwise.
uint64_t fingerprintOf(const FrameView& view, RayBackend backend, uvec2 extent, bool hasLateFields);

} // namespace antumbra::render
