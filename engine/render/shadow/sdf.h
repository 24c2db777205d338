// Shadows that signed distance fields cast in the light of area lights, by cones (Ban, Balint, Valasek 2020, as corrected in
// methods/sdf-cones.md): towards spheres, or towards cells of what has an outline. The approximation: a light's share past the fields and
// its share past all else are taken for independent.
#pragma once

#include "render/fields.h"
#include "render/shadow/lit_frame.h"

namespace antumbra::render {

/// float[lights][pixels], the share of each light of the frame's AreaBlock that is seen; absent without fields, and where rays find all of
/// it.
graph::BufferRef declareFieldShadow(graph::FrameGraph& graph, const LitFrame& frame, std::span<const AreaLightRange> ranges,
                                    graph::BufferRef& counters);
/// Without area lights.
void skipFieldShadow(graph::FrameGraph& graph, std::string_view reason);

} // namespace antumbra::render
