#include "app/surfaces.h"

#include "bake/statics.h"
#include "base/error.h"
#include "scene/populate.h"

namespace antumbra::app {

Surfaces::Surfaces(const scene::SceneFile& file, const bake::BakeSettings& settings)
{
    ecs::World world;
    scene::populate(world, assets, file);
    const bake::Statics statics = bake::staticsOf(world, assets);
    if (statics.objects.empty())
        throw Error("nothing to bake: nothing in the scene is StaticPRT", file.file.string());
    scene = flatten(statics.objects, layOut(statics.objects, {settings.texelsPerMetre, settings.mostTexels}));
}

} // namespace antumbra::app
