// The second character: it stands, turns to the player who walks about, and waves now and then, as chance (seeded) has it.
#pragma once

#include "app/random.h"
#include "game/player.h"

namespace antumbra::game {

struct Companion
{
    float secondsToWave = 2;
    bool isTurning = false; // to the player
};

/// A system, before moveCharacters().
void accompany(ecs::Each<Companion, Intent, const Character, const scene::Transform> companions,
               ecs::Each<const scene::Transform, ecs::With<Player>> players, app::Random& random, ecs::Seconds step);

} // namespace antumbra::game
