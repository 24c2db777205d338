// From the World to a FrameView: the only place that sees both. Simulates nothing and asks nothing of the device.
#pragma once

#include "ecs/world.h"
#include "render/frame_view.h"
#include "scene/assets.h"

namespace antumbra::render {

/// Fills in what is seen: camera, environment, statics, characters, area lights and what blocks them. Models without triangles are left
/// out; where the world has no Camera, that of `view` stays. Knobs, bake, exposure and split are the caller's. Allocates nothing for a view
/// like the last. World matrices and poses must be up to date; the world's resource PoseStore is needed.
void extract(const ecs::World& world, const scene::Assets& assets, FrameView& view);

} // namespace antumbra::render
