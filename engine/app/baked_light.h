// The baked light of a scene that is being played: the bake that lies beside it where there is one that fits, else the reason why not.
// Bakes nothing by itself.
#pragma once

#include "bake/bake.h"
#include "base/file.h"
#include "ecs/world.h"
#include "render/knobs.h"
#include "scene/assets.h"
#include "scene/scene_file.h"

#include <optional>
#include <string>

namespace antumbra::app {

struct BakedLight
{
    std::optional<bake::Bake> bake;
    std::string fault; // one line on why there is none; empty where nothing is StaticPRT, or the scene is no file
};

/// The scene's settings, then `overrides`, as far as they concern the bake. Throws Error as render::set() does.
bake::BakeSettings bakeSettingsOf(const scene::SceneFile& scene, const render::Settings& overrides);

/// After populate(). Where the bake fits, what is StaticPRT is drawn as the atlas charted it.
BakedLight loadBakedLight(ecs::World& world, scene::Assets& assets, const Path& sceneFile, const bake::BakeSettings& settings);

/// One line, where light that should be baked is not: why, and the command that bakes it.
void warnOfMissingBake(const BakedLight& light, const std::string& scene);

} // namespace antumbra::app
