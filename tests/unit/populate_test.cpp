#include "scene/populate.h"

#include "base/error.h"
#include "scene/animator.h"
#include "unit/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace antumbra;
using namespace antumbra::scene;
using ecs::Each;
using ecs::Entity;
using ecs::World;
using testing::HasSubstr;

Path character(const std::string& name) { return Path(ANTUMBRA_SHARED_DIR) / "assets/characters" / name; }

#define SKIP_WITHOUT(path)                                                                                                                 \
    if (!std::filesystem::exists(path))                                                                                                    \
    GTEST_SKIP() << "there is no " << (path)

struct Populated
{
    World world;
    Assets assets;

    explicit Populated(const SceneFile& scene) { populate(world, assets, scene); }

    [[nodiscard]] Entity named(std::string_view text) const
    {
        for (auto [entity, name] : Each<Entity, const Name>(world))
            if (name.text == text)
                return entity;
        return {};
    }
    [[nodiscard]] const Model& modelOf(std::string_view name) const { return assets.models[world.get<Drawable>(named(name)).model]; }
    template <class T>
    [[nodiscard]] const T& only() const
    {
        const T* found = nullptr;
        for (auto [component] : Each<const T>(world)) {
            EXPECT_EQ(found, nullptr) << "more than one";
            found = &component;
        }
        check(found != nullptr, "one");
        return *found;
    }
};

SceneFile sceneOf(const std::string& text)
{
    const TestFolder folder;
    writeText(folder / "scene.json", text);
    return loadScene(folder / "scene.json");
}

SceneEntity entityOf(std::string name, const Path& model)
{
    SceneEntity entity{.name = std::move(name), .mesh = {MeshKind::File, model}};
    entity.isDynamicSkinned = true;
    return entity;
}

std::string faultOf(const SceneFile& scene)
{
    try {
        Populated populated(scene);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Populate, MakesTheSceneItWasTold)
{
    const Populated made(sceneOf(R"({
        "camera": {"position": [1, 2, 3], "target": [0, 1, 0], "vfov_deg": 60},
        "environment": {"sky": [1, 2, 3], "rotation_deg": 90, "intensity": 4},
        "entities": [
            {"name": "ground", "mesh": "plane", "transform": {"position": [0, 5, 0]}, "StaticPRT": {}},
            {"name": "box", "parent": "ground", "mesh": "cube", "transform": {"position": [1, 0, 0]}, "Occluder": {}, "DynamicSkinned": {}},
            {"name": "lamp", "AreaLight": {"shape": "disk", "radius": 2}},
            {"SDFPrimitive": {"shape": "sphere", "radius": 3}}]})"));
    EXPECT_EQ(made.only<Camera>().targetWorld, vec3(0, 1, 0));
    EXPECT_NEAR(made.only<Camera>().verticalFovRadians, kPi / 3, 1e-6f);
    for (auto [camera, transform] : Each<const Camera, const Transform>(made.world))
        EXPECT_EQ(transform.position, vec3(1, 2, 3));

    const Environment& environment = made.only<Environment>();
    EXPECT_NEAR(environment.rotationRadians, kPi / 2, 1e-6f);
    EXPECT_EQ(environment.intensity, 4);
    const ImageF& sky = made.assets.environments.at(environment.image);
    EXPECT_EQ(vec3(sky.values.at(0), sky.values.at(1), sky.values.at(2)), vec3(1, 2, 3));
    EXPECT_EQ(sky.values.size(), size_t{3} * sky.width * sky.height);

    const Entity box = made.named("box");
    EXPECT_EQ(vec3(made.world.get<WorldMatrix>(box).now[3]), vec3(1, 5, 0));
    EXPECT_EQ(vec3(made.world.get<WorldMatrix>(box).before[3]), vec3(1, 5, 0));
    EXPECT_TRUE(made.world.has<DynamicSkinned>(box));
    EXPECT_TRUE(made.world.has<Occluder>(box));
    EXPECT_TRUE(made.world.has<Pose>(box));
    EXPECT_FALSE(made.world.has<Animator>(box)) << "a cube has no clips";
    EXPECT_EQ(made.modelOf("box").mesh.indices.size(), 36u);
    EXPECT_TRUE(made.world.has<StaticPRT>(made.named("ground")));
    EXPECT_FALSE(made.world.has<Pose>(made.named("ground")));
    EXPECT_EQ(made.world.get<AreaLight>(made.named("lamp")).radii, vec2(2));
    EXPECT_FALSE(made.world.has<Drawable>(made.named("lamp")));
    EXPECT_EQ(made.only<SDFPrimitive>().radius, 3);
}

TEST(Populate, WithoutAnEnvironmentThereIsNone)
{
    const Populated made(sceneOf("{}"));
    EXPECT_TRUE(made.assets.environments.empty());
    for ([[maybe_unused]] auto [environment] : Each<const Environment>(made.world))
        ADD_FAILURE() << "an environment";
}

TEST(Populate, MeshesAreLoadedOnceAndMaterialsCopiedOnce)
{
    const Populated made(sceneOf(R"({"entities": [
        {"name": "a", "mesh": "sphere"}, {"name": "b", "mesh": "sphere"}, {"name": "cube", "mesh": "cube"},
        {"name": "red", "mesh": "sphere", "material": {"albedo": [1, 0, 0]}},
        {"name": "red too", "mesh": "sphere", "material": {"albedo": [1, 0, 0]}},
        {"name": "dull", "mesh": "sphere", "material": {"albedo": [1, 0, 0], "specular": 0}}]})"));
    EXPECT_EQ(&made.modelOf("a"), &made.modelOf("b"));
    EXPECT_EQ(&made.modelOf("red"), &made.modelOf("red too"));
    EXPECT_EQ(made.assets.models.size(), 4u);
    EXPECT_EQ(made.modelOf("red").materials.at(0).albedo, vec3(1, 0, 0));
    EXPECT_EQ(made.modelOf("dull").materials.at(0).specular, 0);
    EXPECT_EQ(made.modelOf("a").materials.at(0).albedo, Material{}.albedo);
}

TEST(Populate, AFileUsedTwiceIsLoadedOnce)
{
    const Path fox = character("Fox.glb");
    SKIP_WITHOUT(fox);
    SceneFile scene;
    scene.entities = {entityOf("a", fox), entityOf("b", fox.parent_path() / "../characters/Fox.glb"), entityOf("grey", fox)};
    scene.entities[2].material = Material{.albedo = vec3(0.5f)};
    const Populated made(scene);
    EXPECT_EQ(&made.modelOf("a"), &made.modelOf("b"));
    EXPECT_EQ(made.assets.models.size(), 2u);
    EXPECT_NE(made.world.get<Pose>(made.named("a")).slot, made.world.get<Pose>(made.named("b")).slot);

    const Model& grey = made.modelOf("grey");
    EXPECT_EQ(grey.mesh.indices, made.modelOf("a").mesh.indices);
    ASSERT_EQ(grey.materials.size(), 1u);
    EXPECT_EQ(grey.materials[0].albedoImage, kNoIndex);
    EXPECT_THAT(grey.mesh.triangleMaterials, testing::Each(0u));
}

TEST(Populate, ClipsGoByName)
{
    const Path fox = character("Fox.glb");
    SKIP_WITHOUT(fox);
    SceneFile scene;
    scene.entities = {entityOf("runner", fox), entityOf("first", fox), entityOf("still", fox)};
    scene.entities[0].animation = SceneAnimation{"Run", 2, 0.25f};
    scene.entities[1].animation.emplace();
    const Populated made(scene);
    const auto& runner = made.world.get<Animator>(made.named("runner"));
    EXPECT_EQ(made.modelOf("runner").clips.at(runner.clip).name, "Run");
    EXPECT_EQ(runner.speed, 2);
    EXPECT_EQ(runner.time, 0.25f);
    EXPECT_EQ(made.world.get<Animator>(made.named("first")).clip, 0u);
    EXPECT_EQ(made.world.get<Animator>(made.named("still")).clip, kNoIndex);

    scene.entities[0].animation->clip = "Fly";
    EXPECT_THAT(faultOf(scene), testing::AllOf(HasSubstr("Fox.glb"), HasSubstr("\"Fly\""), HasSubstr("Survey, Walk, Run")));
    scene.entities[0].isDynamicSkinned = false;
    EXPECT_THAT(faultOf(scene), HasSubstr("\"Fly\""));
}

TEST(Populate, ErrorsNameTheFile)
{
    SceneFile scene;
    scene.entities = {entityOf("nobody", "no/such/character.glb")};
    EXPECT_THAT(faultOf(scene), HasSubstr("no/such/character.glb"));
    scene.entities.clear();
    scene.environment = SceneEnvironment{.file = "no/such/sky.hdr"};
    EXPECT_THAT(faultOf(scene), HasSubstr("no/such/sky.hdr"));
}

TEST(Populate, AModelByItselfIsFramed)
{
    for (const char* name : {"Fox.glb", "CesiumMan.glb", "SimpleMorph/SimpleMorph.gltf"}) {
        SCOPED_TRACE(name);
        SKIP_WITHOUT(character(name));
        SceneFile scene = sceneOfModel(character(name), {});
        scene.environment.reset();
        const Populated made(scene);
        const auto& ground = made.world.get<Transform>(made.named("ground"));
        const float radius = ground.scale.x / 12;
        const auto& camera = made.only<Camera>();
        for (auto [seen, transform] : Each<const Camera, const Transform>(made.world)) {
            const float distance = glm::distance(transform.position, seen.targetWorld);
            EXPECT_GT(distance * std::sin(0.5f * seen.verticalFovRadians), radius) << "all is in sight";
            EXPECT_LT(seen.nearMetres, distance - radius);
            EXPECT_GT(transform.position.z, seen.targetWorld.z) << "from the front";
        }
        EXPECT_LE(ground.position.y, camera.targetWorld.y);
        EXPECT_EQ(vec3(made.world.get<WorldMatrix>(made.named("ground")).now[3]), ground.position);
    }
}

} // namespace
