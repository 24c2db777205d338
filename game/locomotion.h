// How a character walks, runs, turns and waves once somebody has said what it intends: it speeds up and turns like a body, stays on
// its ground, and plays the clips that go with it. Has no will of its own, and no physics: walls do not stop it.
#pragma once

#include "ecs/schedule.h"
#include "scene/animator.h"
#include "scene/components.h"

#include <optional>

namespace antumbra::game {

/// Angles are about +Y, from +Z, which is where characters look at rest.
float facingOf(vec2 directionXZ);
/// The way from one angle to another, -pi to pi.
float angleBetween(float from, float to);

/// A resource: where feet may go.
struct Ground
{
    vec2 lowest{-1e6f};
    vec2 highest{1e6f};
};

/// Made new by somebody every step.
struct Intent
{
    vec2 walk{0}; // in X and Z; 1 long at full walking speed
    bool isRunning = false;
    bool waves = false;          // begins to
    std::optional<float> facing; // where it turns while it stands
};

/// Clips of the model by what they show, kNoIndex where there is none; models without any of them only slide.
struct Gaits
{
    uint32_t idle = scene::kNoIndex;
    uint32_t walk = scene::kNoIndex;
    uint32_t run = scene::kNoIndex;
    uint32_t wave = scene::kNoIndex;
    uint32_t turn = scene::kNoIndex;
    float waveSeconds = 0;
};

/// Found by name, in capitals or not.
Gaits gaitsOf(const scene::Model& model);

struct Character
{
    Gaits gaits;
    float scale = 1;          // of its speeds, against a person of 1.75 m
    quat upright{1, 0, 0, 0}; // its rotation when it faces 0
    float facing = 0;
    float speed = 0; // metres a second, ahead
    float waveSecondsLeft = 0;
    bool isTurning = false; // on the spot
};

Character makeCharacter(const scene::Model& model, const scene::Transform& transform);

/// A system, after all that write Intent.
void moveCharacters(ecs::Each<Character, scene::Transform, const Intent, ecs::Maybe<scene::Animator>> characters, const Ground& ground,
                    ecs::Seconds step);

} // namespace antumbra::game
