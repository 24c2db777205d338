// How much of one area light reaches what is seen: the AOV visibility:LIGHT. Draws nothing; it makes the views to draw, and reads what they
// gave.
#pragma once

#include "ecs/world.h"
#include "render/frame_view.h"
#include "scene/images.h"

#include <optional>
#include <string>
#include <string_view>

namespace antumbra::app {

/// The light that an AOV of this name is about; none where it is about no light.
std::optional<std::string> lightOfAov(std::string_view aov);

/// The light of that name in `view`, which shows `world`. Throws Error that lists the lights there are.
uint32_t lightNamed(const ecs::World& world, const render::FrameView& view, const std::string& name);

/// The view with no light but this one, and the same things before it. Its radiance is 1 at most, whatever it was.
render::FrameView viewOfLight(const render::FrameView& view, uint32_t light);

/// Pixel by pixel `lit` as a share of `unshadowed`, of three channels each; 0..1, and 0 where nothing arrives in either.
scene::ImageF shareOf(const scene::ImageF& lit, const scene::ImageF& unshadowed);

} // namespace antumbra::app
