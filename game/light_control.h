// Light that moves: the environment turns about +Y as the player asks, in the player's time, so that it turns while the game is paused;
// lamps circle in the game's.
#pragma once

#include "app/input_frame.h"
#include "ecs/each.h"
#include "ecs/schedule.h"
#include "scene/components.h"

namespace antumbra::game {

inline constexpr float kLightRadiansPerSecond = 0.8f;

/// A system.
void circle(ecs::Each<scene::Transform, scene::Orbit> circling, ecs::Seconds step);
/// A system.
void turnLight(ecs::Each<scene::Environment> environments, const app::InputFrame& input);

} // namespace antumbra::game
