// The game: who is the player, who the companion, where they may walk, and the systems in their order.
#pragma once

#include "ecs/schedule.h"

namespace antumbra::game {

/// The entity named "player", or else the first that moves, is the player; the one named "companion" keeps it company.
void addGameplay(ecs::World& world, ecs::Schedule& schedule);

} // namespace antumbra::game
