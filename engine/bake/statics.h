// Between a World and its bake: which entities are baked, and how they are drawn afterwards. The only file of bake/ that sees a World.
#pragma once

#include "bake/atlas.h"
#include "ecs/world.h"
#include "scene/assets.h"

namespace antumbra::bake {

/// Every entity that is StaticPRT and has triangles, in the order of the scene. `objects` point into the assets.
struct Statics
{
    std::vector<ecs::Entity> entities;
    std::vector<AtlasObject> objects;
};

Statics staticsOf(const ecs::World& world, const scene::Assets& assets);

/// From now on each of them is drawn as the atlas charted it, from a model of its own. The objects of `statics` dangle afterwards.
void drawCharted(ecs::World& world, scene::Assets& assets, const Statics& statics, Atlas atlas);

} // namespace antumbra::bake
