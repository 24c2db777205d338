// The camera goes around what it looks at, by the player's hand and in the player's time: it moves while the game is paused.
// It starts as the scene placed it. It passes through walls.
#pragma once

#include "app/input_frame.h"
#include "ecs/each.h"
#include "scene/components.h"

namespace antumbra::game {

struct Player;

/// A resource. The camera stands at `yaw` about +Y (from +Z) and `pitch` above the horizon as seen from its target.
struct CameraRig
{
    float yaw = 0;
    float pitch = 0;
    float distance = 5;       // metres
    float placedDistance = 5; // as the scene has it
    vec3 target{0};
    vec3 targetFromPlayer{0}; // kept while the player walks about
    bool isFollowing = true;  // turns behind the player who walks; else it only orbits
};

/// As the scene placed the camera; `player` is the position of the player, or the camera's target where there is none.
CameraRig makeCameraRig(const scene::Transform& camera, vec3 target, vec3 player);

/// A system, after moveCharacters().
void placeCamera(ecs::Each<scene::Camera, scene::Transform> cameras, ecs::Each<const scene::Transform, ecs::With<Player>> players,
                 const app::InputFrame& input, CameraRig& rig);

} // namespace antumbra::game
