#include "bake/statics.h"

#include "base/check.h"
#include "ecs/each.h"
#include "scene/components.h"

#include <utility>

namespace antumbra::bake {

Statics staticsOf(const ecs::World& world, const scene::Assets& assets)
{
    Statics statics;
    for (auto [entity, drawable, matrix] :
         ecs::Each<ecs::Entity, const scene::Drawable, const scene::WorldMatrix, ecs::With<scene::StaticPRT>>(world))
    {
        const scene::Model& model = assets.models[drawable.model];
        if (model.mesh.indices.empty())
            continue;
        statics.entities.push_back(entity);
        statics.objects.push_back({&model, matrix.now});
    }
    return statics;
}

void drawCharted(ecs::World& world, scene::Assets& assets, const Statics& statics, Atlas atlas)
{
    check(statics.entities.size() == atlas.meshes.size(), "one charted mesh an entity");
    for (size_t i = 0; i < statics.entities.size(); ++i) {
        auto& drawable = world.get<scene::Drawable>(statics.entities[i]);
        const scene::Model& drawn = assets.models[drawable.model];
        scene::Model charted = scene::rigidModel(drawn.name, std::move(atlas.meshes[i]), {});
        charted.materials = drawn.materials;
        charted.images = drawn.images;
        for (scene::Material& material : charted.materials)
            material.twoSided = false; // both sides are there
        drawable.model = static_cast<uint32_t>(assets.models.size());
        assets.models.push_back(std::move(charted));
    }
}

} // namespace antumbra::bake
