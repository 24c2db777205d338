// The environment turns about +Y as the player asks, in the player's time: it turns while the game is paused.
#pragma once

#include "app/input_frame.h"
#include "ecs/each.h"
#include "scene/components.h"

namespace antumbra::game {

inline constexpr float kLightRadiansPerSecond = 0.8f;

/// A system.
void turnLight(ecs::Each<scene::Environment> environments, const app::InputFrame& input);

} // namespace antumbra::game
