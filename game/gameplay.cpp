#include "game/gameplay.h"

#include "game/camera_rig.h"
#include "game/companion.h"
#include "game/light_control.h"
#include "game/player.h"
#include "game/time_control.h"

namespace antumbra::game {

namespace {

using ecs::Each;
using ecs::Entity;

constexpr float kBodyRadius = 0.35f; // metres kept from the edge of the ground

Entity findCharacter(const ecs::World& world, std::string_view wanted)
{
    for (auto [entity, name] : Each<Entity, const scene::Name, ecs::With<scene::DynamicSkinned>>(world))
        if (name.text == wanted)
            return entity;
    return {};
}

Entity findFirstCharacter(const ecs::World& world)
{
    for (auto [entity] : Each<Entity, ecs::With<scene::DynamicSkinned>, ecs::With<scene::Drawable>>(world))
        return entity;
    return {};
}

void makeActor(ecs::World& world, Entity entity)
{
    const scene::Model& model = world.resource<scene::Assets>().models[world.get<scene::Drawable>(entity).model];
    world.add(entity, makeCharacter(model, world.get<scene::Transform>(entity)));
    world.add(entity, Intent{});
}

/// What does not move is ground; without any, there is no edge to it.
Ground findGround(const ecs::World& world)
{
    Aabb bounds;
    for (auto [drawable, matrix] : Each<const scene::Drawable, const scene::WorldMatrix, ecs::Without<scene::DynamicSkinned>>(world)) {
        const Aabb local = world.resource<scene::Assets>().models[drawable.model].mesh.bounds();
        for (int corner = 0; corner < 8 && !local.isEmpty(); ++corner) {
            const vec3 share{corner & 1, corner >> 1 & 1, corner >> 2 & 1};
            bounds.add(vec3(matrix.now * vec4(glm::mix(local.lowest, local.highest, share), 1)));
        }
    }
    if (bounds.isEmpty())
        return {};
    return {vec2(bounds.lowest.x, bounds.lowest.z) + kBodyRadius, vec2(bounds.highest.x, bounds.highest.z) - kBodyRadius};
}

void castRoles(ecs::World& world)
{
    const Entity named = findCharacter(world, "player");
    const Entity player = named ? named : findFirstCharacter(world);
    const Entity companion = findCharacter(world, "companion");
    if (player) {
        makeActor(world, player);
        world.add(player, Player{});
    }
    if (companion && companion != player) {
        makeActor(world, companion);
        world.add(companion, Companion{});
    }
    for (auto [camera, transform] : Each<const scene::Camera, const scene::Transform>(world)) {
        const vec3 followed = player ? world.get<scene::Transform>(player).position : camera.targetWorld;
        world.setResource(makeCameraRig(transform, camera.targetWorld, followed));
    }
}

} // namespace

void addGameplay(ecs::World& world, ecs::Schedule& schedule)
{
    world.setResource(Clock{});
    world.setResource(CameraRig{});
    world.setResource(findGround(world));
    castRoles(world);
    schedule.add("control time", controlTime);
    schedule.add("turn light", turnLight);
    schedule.add("control player", controlPlayer);
    schedule.add("accompany", accompany).after("control time").after("control player");
    schedule.add("move characters", moveCharacters).after("accompany");
    schedule.add("place camera", placeCamera).after("move characters");
    schedule.add("circle", circle).after("control time").after("place camera");
}

} // namespace antumbra::game
