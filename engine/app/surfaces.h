// What is baked of a scene, laid out as a bake's settings say. Bakes nothing.
#pragma once

#include "bake/bake.h"
#include "bake/static_scene.h"
#include "scene/assets.h"
#include "scene/scene_file.h"

namespace antumbra::app {

/// The surfaces refer to the assets beside them: it neither moves nor is copied.
struct Surfaces
{
    /// Throws Error as populate() does, and where nothing in the scene is StaticPRT.
    Surfaces(const scene::SceneFile& file, const bake::BakeSettings& settings);
    Surfaces(const Surfaces&) = delete;
    Surfaces& operator=(const Surfaces&) = delete;

    scene::Assets assets;
    bake::StaticScene scene;
};

} // namespace antumbra::app
