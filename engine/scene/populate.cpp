#include "scene/populate.h"

#include "base/error.h"
#include "base/log.h"
#include "scene/animator.h"
#include "scene/gltf.h"
#include "scene/hierarchy.h"
#include "scene/solid_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

namespace antumbra::scene {

namespace {

Model shapeModel(const std::string& name, Mesh mesh)
{
    orderTriangles(mesh, mesh.positions);
    return rigidModel(name, std::move(mesh), {});
}

Model loadModel(const SceneMesh& mesh)
{
    switch (mesh.kind) {
    case MeshKind::Plane: return shapeModel("plane", makePlane());
    case MeshKind::Cube: return shapeModel("cube", makeCube());
    case MeshKind::Sphere: return shapeModel("sphere", makeSphere());
    case MeshKind::Disk: return shapeModel("disk", makeDisk());
    case MeshKind::Icosphere: return shapeModel("icosphere", makeIcosphere());
    case MeshKind::Frustum: return shapeModel("frustum", makeFrustum());
    case MeshKind::File: return loadGltf(mesh.file);
    case MeshKind::None: break;
    }
    check(false, "a mesh");
    return {};
}

Model withMaterial(Model model, const Material& material)
{
    model.materials = {material};
    model.images.clear();
    std::ranges::fill(model.mesh.triangleMaterials, 0);
    return model;
}

/// What a scene file can say of a material.
auto valuesOf(const Material& m)
{
    return std::tuple(m.albedo.x, m.albedo.y, m.albedo.z, m.roughness, m.metallic, m.specular, m.emission.x, m.emission.y, m.emission.z,
                      m.twoSided);
}

/// Models by what the scene calls them, so that none is loaded or copied twice.
class ModelLoader
{
public:
    explicit ModelLoader(Assets& assets) : assets_(assets) {}

    uint32_t indexOf(const SceneEntity& entity)
    {
        const auto [loaded, isNew] = loaded_.try_emplace({entity.mesh.kind, entity.mesh.file.lexically_normal()}, 0u);
        if (isNew)
            loaded->second = add(loadModel(entity.mesh));
        if (!entity.material)
            return loaded->second;
        const auto [copied, isNewCopy] = copied_.try_emplace({loaded->second, valuesOf(*entity.material)}, 0u);
        if (isNewCopy)
            copied->second = add(withMaterial(assets_.models[loaded->second], *entity.material));
        return copied->second;
    }

private:
    using Values = decltype(valuesOf(std::declval<Material>()));

    uint32_t add(Model model)
    {
        assets_.models.push_back(std::move(model));
        return static_cast<uint32_t>(assets_.models.size() - 1);
    }

    Assets& assets_;
    std::map<std::pair<MeshKind, Path>, uint32_t> loaded_;
    std::map<std::pair<uint32_t, Values>, uint32_t> copied_;
};

ImageF uniformSky(vec3 radiance)
{
    // Fine enough for what is integrated over it texel by texel.
    ImageF image{.width = 64, .height = 32, .channels = 3, .values = {}};
    for (uint32_t texel = 0; texel < image.width * image.height; ++texel)
        image.values.insert(image.values.end(), {radiance.x, radiance.y, radiance.z});
    return image;
}

void addCamera(ecs::World& world, const SceneCamera& camera)
{
    world.create(Camera{.verticalFovRadians = camera.verticalFovRadians, .targetWorld = camera.target},
                 Transform{.position = camera.position});
}

void addEnvironment(ecs::World& world, Assets& assets, const SceneFile& scene)
{
    if (!scene.environment)
        return;
    const SceneEnvironment& environment = *scene.environment;
    assets.environments.push_back(environment.file.empty() ? uniformSky(environment.sky) : loadRadiance(environment.file));
    const auto image = static_cast<uint32_t>(assets.environments.size() - 1);
    world.create(Environment{image, environment.rotationRadians, environment.intensity});
}

uint32_t findClip(const Model& model, const SceneEntity& entity)
{
    const std::string& name = entity.animation->clip;
    if (name.empty())
        return model.clips.empty() ? kNoIndex : 0;
    const auto found = std::ranges::find(model.clips, name, &Clip::name);
    if (found != model.clips.end())
        return static_cast<uint32_t>(found - model.clips.begin());
    std::vector<std::string_view> known;
    for (const Clip& clip : model.clips)
        known.push_back(clip.name);
    throw Error(known.empty() ? fmt::format("no clip \"{}\": the model has none", name)
                              : fmt::format("no clip \"{}\"; there are: {}", name, fmt::join(known, ", ")),
                entity.mesh.file.string());
}

void addAnimator(ecs::World& world, ecs::Entity made, const SceneEntity& entity, const Model& model)
{
    Animator animator;
    if (entity.animation) {
        animator.clip = findClip(model, entity);
        animator.time = entity.animation->offsetSeconds;
        animator.speed = entity.animation->speed;
        if (!entity.isDynamicSkinned)
            logWarning("{}: \"{}\" is not DynamicSkinned and stays at rest", entity.mesh.file.string(), entity.name);
    }
    if (entity.isDynamicSkinned && !model.clips.empty())
        world.add(made, animator);
}

template <class T>
void addWherePresent(ecs::World& world, ecs::Entity made, const std::optional<T>& component)
{
    if (component)
        world.add(made, *component);
}

void addOrbit(ecs::World& world, ecs::Entity made, const SceneEntity& entity)
{
    if (!entity.orbit)
        return;
    Orbit orbit = *entity.orbit;
    orbit.centre = entity.transform.position;
    world.add(made, orbit);
}

void addSDFMaterial(ecs::World& world, ecs::Entity made, const SceneEntity& entity)
{
    if (!entity.sdfPrimitive)
        return;
    const Material material = entity.material.value_or(Material{});
    world.add(made, SDFMaterial{material.albedo, material.roughness, material.metallic, material.specular});
}

/// One entity for each of the scene's, in their order.
std::vector<ecs::Entity> addEntities(ecs::World& world, Assets& assets, const SceneFile& scene)
{
    ModelLoader models(assets);
    std::vector<ecs::Entity> made;
    for (const SceneEntity& entity : scene.entities)
        made.push_back(world.create(entity.transform, WorldMatrix{}));
    for (size_t i = 0; i < made.size(); ++i) {
        const SceneEntity& entity = scene.entities[i];
        if (!entity.name.empty())
            world.add(made[i], Name{entity.name});
        if (entity.parent != kNoIndex)
            world.add(made[i], Parent{made[entity.parent]});
        if (entity.isStaticPRT)
            world.add(made[i], StaticPRT{});
        if (entity.isDynamicSkinned)
            world.add(made[i], DynamicSkinned{});
        addWherePresent(world, made[i], entity.areaLight);
        addOrbit(world, made[i], entity);
        addWherePresent(world, made[i], entity.occluder);
        addWherePresent(world, made[i], entity.sdfPrimitive);
        addSDFMaterial(world, made[i], entity);
        if (entity.mesh.kind == MeshKind::None)
            continue;
        const uint32_t model = models.indexOf(entity);
        world.add(made[i], Drawable{model});
        addAnimator(world, made[i], entity, assets.models[model]);
    }
    return made;
}

// Twice, so that what stands still does not seem to have moved.
void placeAll(ecs::World& world)
{
    for (int run = 0; run < 2; ++run)
        updateWorldMatrices(ecs::Each<WorldMatrix, const Transform, ecs::Maybe<const Parent>>(world));
}

void poseAll(ecs::World& world, const Assets& assets)
{
    auto& poses = world.setResource(PoseStore{});
    ecs::Changes changes;
    assignPoses(ecs::Each<ecs::Entity, const Drawable, ecs::Maybe<const Animator>, ecs::With<DynamicSkinned>, ecs::Without<Pose>>(world),
                ecs::Each<const Pose, ecs::With<Drawable>, ecs::With<DynamicSkinned>>(world), ecs::Commands(world, changes), assets, poses);
    changes.apply(world);
    animate(ecs::Each<Animator, Pose, const Drawable>(world), assets, poses, ecs::Seconds{0});
}

std::vector<vec3> restPositions(const Model& model)
{
    LocalPose pose;
    setRest(pose, model);
    std::vector<mat4> joints(model.joints.size());
    std::vector<mat4> nodeToModel;
    resolve(joints, nodeToModel, pose, model);
    return posedMesh(model, joints, pose.morphWeights).positions;
}

struct Shown
{
    vec3 centre{0};
    float radius = 0;
    float lowestY = 0;
};

/// Of all that is drawn but the ground, at rest; nothing where that is nothing.
std::optional<Shown> findShown(const ecs::World& world, const Assets& assets, const SceneFile& scene, std::span<const ecs::Entity> made)
{
    Aabb bounds;
    for (size_t i = 0; i < made.size(); ++i) {
        const Drawable* drawable = world.find<Drawable>(made[i]);
        if (drawable == nullptr || scene.entities[i].mesh.kind == MeshKind::Plane)
            continue;
        const mat4& toWorld = world.get<WorldMatrix>(made[i]).now;
        for (const vec3& position : restPositions(assets.models[drawable->model]))
            bounds.add(vec3(toWorld * vec4(position, 1)));
    }
    const Shown shown{bounds.centre(), 0.5f * glm::length(bounds.extent()), bounds.lowest.y};
    return shown.radius > 0 && std::isfinite(shown.radius) ? std::optional(shown) : std::nullopt;
}

/// Puts the camera where all is in sight, from the front and a little above, and the planes under it, wide enough for shadows.
void frame(ecs::World& world, const Shown& shown, const SceneFile& scene, std::span<const ecs::Entity> made)
{
    for (auto [camera, transform] : ecs::Each<Camera, Transform>(world)) {
        const float distance = 1.1f * shown.radius / std::sin(0.5f * camera.verticalFovRadians);
        transform.position = shown.centre + distance * glm::normalize(vec3(0.4f, 0.3f, 1));
        camera.targetWorld = shown.centre;
        camera.nearMetres = std::min(camera.nearMetres, 0.1f * (distance - shown.radius));
    }
    for (size_t i = 0; i < made.size(); ++i) {
        if (scene.entities[i].mesh.kind != MeshKind::Plane)
            continue;
        auto& ground = world.get<Transform>(made[i]);
        ground.position = {shown.centre.x, shown.lowestY, shown.centre.z};
        ground.scale = {12 * shown.radius, 1, 12 * shown.radius};
    }
}

} // namespace

void populate(ecs::World& world, Assets& assets, const SceneFile& scene)
{
    addCamera(world, scene.camera);
    addEnvironment(world, assets, scene);
    const std::vector<ecs::Entity> made = addEntities(world, assets, scene);
    placeAll(world);
    if (scene.autoFrame) {
        if (const std::optional<Shown> shown = findShown(world, assets, scene, made)) {
            frame(world, *shown, scene, made);
            placeAll(world);
        }
    }
    poseAll(world, assets);
}

} // namespace antumbra::scene
