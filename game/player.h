// The character that the player moves: from input, as the camera sees it, to what the character intends.
#pragma once

#include "app/input_frame.h"
#include "game/camera_rig.h"
#include "game/locomotion.h"

namespace antumbra::game {

/// Marks one character.
struct Player
{
};

/// A system, before moveCharacters().
void controlPlayer(ecs::Each<Intent, ecs::With<Player>> players, const CameraRig& rig, const app::InputFrame& input);

} // namespace antumbra::game
