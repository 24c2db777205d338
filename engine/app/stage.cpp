#include "app/stage.h"

#include "app/shadow_bodies.h"
#include "base/error.h"
#include "base/file.h"
#include "base/fnv1a.h"
#include "render/extract.h"
#include "scene/animator.h"
#include "scene/hierarchy.h"
#include "scene/populate.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <type_traits>

namespace antumbra::app {

namespace {

constexpr const char* kModelEnvironment = "environments/overcast.hdr"; // for a model that comes without a scene

std::vector<std::string> knownScenes()
{
    std::vector<std::string> names;
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(projectPath("assets") / "scenes", failure))
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

} // namespace

void noGameplay(ecs::World&, ecs::Schedule&) {}

scene::SceneFile findScene(const std::string& scene, const scene::Settings& overrides)
{
    const Path file = scene;
    const std::string extension = file.extension().string();
    if (extension == ".glb" || extension == ".gltf")
        return scene::sceneOfModel(file, projectPath("assets") / kModelEnvironment);
    if (extension == ".json")
        return scene::loadScene(file, overrides);
    const std::vector<std::string> known = knownScenes();
    if (std::ranges::find(known, scene) == known.end())
        throw Error(fmt::format("no such scene; there are {}, and files that end in .json, .glb or .gltf", fmt::join(known, ", ")), scene);
    return scene::loadScene(projectPath("assets") / "scenes" / (scene + ".json"), overrides);
}

Stage::Stage(const scene::SceneFile& scene, uint64_t seed, Gameplay gameplay, const render::Settings& overrides) : settings_(scene.settings)
{
    auto& assets = world_.setResource(scene::Assets{});
    scene::populate(world_, assets, scene);
    makeShadowBodies(world_, assets, scene.file.string());
    bakedLight_ = loadBakedLight(world_, assets, scene.file, bakeSettingsOf(scene, overrides));
    world_.setResource(InputFrame{});
    world_.setResource(Random(seed));
    world_.setResource(ecs::Seconds{kStepSeconds});
    gameplay(world_, gameplay_);
    gameplay_.compile();
    motion_.add("assign poses", scene::assignPoses);
    motion_.add("animate", scene::animate).after("assign poses");
    motion_.add("world matrices", scene::updateWorldMatrices);
    motion_.compile();
}

void Stage::step(const InputFrame& input)
{
    world_.resource<InputFrame>() = input;
    world_.resource<ecs::Seconds>().value = kStepSeconds;
    gameplay_.run(world_);
    motion_.run(world_);
    ++stepCount_;
}

void Stage::advanceClips(float seconds)
{
    world_.resource<ecs::Seconds>().value = seconds;
    motion_.run(world_);
}

uint64_t Stage::stateHash() const
{
    Fnv1a hash;
    hash.add(stepCount_);
    hash.add(world_.resource<Random>().state());
    for (auto [entity, transform] : ecs::Each<ecs::Entity, const scene::Transform>(world_)) {
        hash.add(entity);
        hash.add(transform);
    }
    for (auto [animator] : ecs::Each<const scene::Animator>(world_))
        hash.add(animator);
    for (auto [environment] : ecs::Each<const scene::Environment>(world_))
        hash.add(environment);
    for (auto [camera] : ecs::Each<const scene::Camera>(world_))
        hash.add(camera);
    return hash.value();
}

void Stage::extract(render::FrameView& view) const
{
    render::extract(world_, assets(), view);
    view.bake = bakedLight_.bake ? &*bakedLight_.bake : nullptr;
}

} // namespace antumbra::app
