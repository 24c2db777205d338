// From a scene file to a World that can be drawn: loads what the file names, makes the entities, and poses them. Starts nothing
// and opens no device.
#pragma once

#include "ecs/world.h"
#include "scene/assets.h"
#include "scene/scene_file.h"

namespace antumbra::scene {

/// Adds a camera, an environment and the scene's entities to `world`, gives it the resource PoseStore, and brings world matrices and
/// poses up to date. Every file is loaded once; a material of an entity's own makes a copy of the model with it. Without an environment
/// there is no light. What is DynamicSkinned and has clips gets an Animator, at rest where the scene says no "animation".
/// Throws Error that names the file, for a file that does not load and for an unknown clip: `world` and `assets` are then to be dropped.
void populate(ecs::World& world, Assets& assets, const SceneFile& scene);

} // namespace antumbra::scene
