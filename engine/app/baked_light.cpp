#include "app/baked_light.h"

#include "bake/bake_file.h"
#include "bake/static_scene.h"
#include "bake/statics.h"
#include "base/error.h"
#include "base/log.h"

namespace antumbra::app {

bake::BakeSettings bakeSettingsOf(const scene::SceneFile& scene, const render::Settings& overrides)
{
    return resolveKnobs(render::DeviceClass::Gpu, scene.settings, overrides).prt.settings;
}

BakedLight loadBakedLight(ecs::World& world, scene::Assets& assets, const Path& sceneFile, const bake::BakeSettings& settings)
{
    const bake::Statics statics = bake::staticsOf(world, assets);
    if (statics.objects.empty() || sceneFile.empty())
        return {};
    try {
        bake::Bake bake = bake::loadBake(bake::bakePathOf(sceneFile));
        bake::Atlas atlas = bake::layOut(statics.objects, {settings.texelsPerMetre, settings.mostTexels});
        const bake::StaticScene scene = bake::flatten(statics.objects, atlas);
        if (std::string why = bake::staleness(bake, hashOf(scene), settings); !why.empty())
            return {.bake = {}, .fault = bake::bakePathOf(sceneFile).string() + ": " + why};
        bake::drawCharted(world, assets, statics, std::move(atlas));
        return {.bake = std::move(bake), .fault = {}};
    } catch (const Error& error) {
        return {.bake = {}, .fault = error.what()};
    }
}

void warnOfMissingBake(const BakedLight& light, const std::string& scene)
{
    if (!light.fault.empty())
        logWarning("{}; StaticPRT is lit without bake: build/tools/bake {} makes one", light.fault, scene);
}

} // namespace antumbra::app
