#include "render/extract.h"

#include "base/error.h"
#include "render/field_steps.h"
#include "scene/animator.h"
#include "scene/populate.h"
#include "tests/unit/allocation_counter.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace antumbra;
using namespace antumbra::scene;
using ecs::Each;
using ecs::Entity;
using ecs::World;
using render::extract;
using render::FrameView;

SceneEntity shape(MeshKind kind, vec3 position, bool isDynamic)
{
    SceneEntity entity{.transform = {.position = position}, .mesh = {kind, {}}};
    entity.isDynamicSkinned = isDynamic;
    return entity;
}

/// A plane and a sphere that stand, two cubes that move.
struct Stage
{
    World world;
    Assets assets;
    FrameView view;

    Stage()
    {
        SceneFile scene;
        scene.camera = {.position = {0, 2, 5}, .target = {0, 2, -5}, .verticalFovRadians = 0.5f};
        scene.environment = SceneEnvironment{.rotationRadians = 0.25f, .intensity = 3};
        scene.entities = {shape(MeshKind::Plane, {0, 0, 0}, false), shape(MeshKind::Sphere, {1, 2, 3}, false),
                          shape(MeshKind::Cube, {4, 5, 6}, true), shape(MeshKind::Cube, {7, 8, 9}, true)};
        scene.entities[0].isStaticPRT = true;
        populate(world, assets, scene);
    }

    Camera& camera(vec3 position)
    {
        Camera* found = nullptr;
        for (auto [camera, transform] : Each<Camera, Transform>(world)) {
            transform.position = position;
            found = &camera;
        }
        return *found;
    }
    vec3 seenAlong(vec3 directionView)
    {
        extract(world, assets, view);
        return view.camera.rotation * directionView;
    }
};

void expectNear(vec3 actual, vec3 expected)
{
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(actual[i], expected[i], 1e-5f) << "component " << i;
}

TEST(Extract, StaticsAndCharactersWithTheirMatrices)
{
    Stage stage;
    extract(stage.world, stage.assets, stage.view);
    const FrameView& view = stage.view;
    ASSERT_EQ(view.statics.size(), 2u);
    EXPECT_EQ(stage.assets.models[view.statics[0].model].name, "plane");
    EXPECT_EQ(vec3(view.statics[1].world[3]), vec3(1, 2, 3));
    ASSERT_EQ(view.characters.size(), 2u);
    EXPECT_EQ(vec3(view.characters[0].world[3]), vec3(4, 5, 6));
    EXPECT_EQ(vec3(view.characters[1].world[3]), vec3(7, 8, 9));
    EXPECT_EQ(view.characters[0].model, view.characters[1].model);
    EXPECT_NE(view.characters[0].slot, view.characters[1].slot);
    EXPECT_NE(view.characters[0].poseVersion, 0u);
    EXPECT_EQ(view.characters[1].firstJoint, 1u);
    EXPECT_EQ(view.joints.size(), 2u);
    EXPECT_TRUE(view.morphWeights.empty());

    extract(stage.world, stage.assets, stage.view);
    EXPECT_EQ(view.statics.size(), 2u) << "nothing of the frame before is left";
    EXPECT_EQ(view.joints.size(), 2u);
}

TEST(Extract, JointsAndWeightsAreThoseOfThePose)
{
    Model model = rigidModel("morphed", makeCube(), {});
    model.restMorphWeights = {0.25f, 0.75f};
    model.nodes[0].rest.translation = vec3(1, 2, 3);
    Stage stage;
    stage.assets.models.push_back(std::move(model));
    const auto index = static_cast<uint32_t>(stage.assets.models.size() - 1);
    const Entity entity = stage.world.create(WorldMatrix{}, Drawable{index}, DynamicSkinned{});
    stage.world.add(entity, stage.world.resource<PoseStore>().give(entity, {}, stage.assets.models[index]));

    extract(stage.world, stage.assets, stage.view);
    ASSERT_EQ(stage.view.characters.size(), 3u);
    const render::CharacterDraw& drawn = stage.view.characters[2];
    EXPECT_EQ(vec3(stage.view.joints.at(drawn.firstJoint)[3]), vec3(1, 2, 3));
    EXPECT_EQ(drawn.firstMorphWeight, 0u);
    EXPECT_EQ(stage.view.morphWeights, (std::vector<float>{0.25f, 0.75f}));
    EXPECT_EQ(drawn.poseVersion, stage.world.get<Pose>(entity).version);
}

TEST(Extract, ModelsWithoutTrianglesAreLeftOut)
{
    Stage stage;
    stage.assets.models.push_back(rigidModel("nothing", {}, {}));
    const auto index = static_cast<uint32_t>(stage.assets.models.size() - 1);
    stage.world.create(WorldMatrix{}, Drawable{index});
    const Entity mover = stage.world.create(WorldMatrix{}, Drawable{index}, DynamicSkinned{});
    stage.world.add(mover, stage.world.resource<PoseStore>().give(mover, {}, stage.assets.models[index]));
    extract(stage.world, stage.assets, stage.view);
    EXPECT_EQ(stage.view.statics.size(), 2u);
    EXPECT_EQ(stage.view.characters.size(), 2u);
    EXPECT_EQ(stage.view.joints.size(), 2u);
}

TEST(Extract, CameraAndEnvironment)
{
    Stage stage;
    stage.view.exposure = 7;
    extract(stage.world, stage.assets, stage.view);
    EXPECT_EQ(stage.view.camera.eye, vec3(0, 2, 5));
    EXPECT_EQ(stage.view.camera.verticalFovRadians, 0.5f);
    EXPECT_LT(stage.view.environment.image, stage.assets.environments.size());
    EXPECT_EQ(stage.view.environment.rotationRadians, 0.25f);
    EXPECT_EQ(stage.view.environment.intensity, 3);
    EXPECT_EQ(stage.view.exposure, 7) << "not extract's business";
}

TEST(Extract, TheCameraLooksAtItsTarget)
{
    Stage stage;
    for (const vec3 target : {vec3(0, 0, -1), vec3(3, 1, 2), vec3(0, 4, 0), vec3(0, -2, 0), vec3(1e-6f, -2, 0)}) {
        stage.camera(vec3(0)).targetWorld = target;
        expectNear(stage.seenAlong({0, 0, -1}), glm::normalize(target));
        EXPECT_NEAR(stage.seenAlong({1, 0, 0}).y, 0, 1e-5f) << "level";
        EXPECT_GE(stage.seenAlong({0, 1, 0}).y, -1e-5f) << "upright";
    }
}

TEST(Extract, ACameraAtItsTargetKeepsItsRotation)
{
    Stage stage;
    stage.camera(vec3(1)).targetWorld = vec3(1);
    for (auto [camera, transform] : Each<const Camera, Transform>(stage.world))
        transform.rotation = glm::angleAxis(kPi / 2, vec3(0, 1, 0));
    expectNear(stage.seenAlong({0, 0, -1}), {-1, 0, 0});
}

SceneEntity primitive(const std::string& name, int32_t order, uint32_t field)
{
    SceneEntity entity;
    entity.name = name;
    entity.sdfPrimitive =
        SDFPrimitive{.radius = static_cast<float>(10 * field + 1) + 0.1f * static_cast<float>(order), .order = order, .field = field};
    return entity;
}

TEST(Extract, FieldsRunByTheirOrder)
{
    SceneFile scene;
    scene.entities = {primitive("a", 3, 1), primitive("b", 2, 0), primitive("c", 1, 1), primitive("d", 2, 0)};
    scene.entities[3].sdfPrimitive->radius = 7;
    World world;
    Assets assets;
    populate(world, assets, scene);
    FrameView view;
    extract(world, assets, view);
    ASSERT_EQ(view.fieldSteps.size(), 4u);
    constexpr float kRadii[] = {1.2f, 7, 11.1f, 11.3f};
    constexpr uint32_t kFlags[] = {shader::kFieldBegins, 0, shader::kFieldBegins, 0};
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(view.fieldSteps[i].step.size.y, kRadii[i]);
        EXPECT_EQ(view.fieldSteps[i].step.flags, kFlags[i]);
    }
}

TEST(Extract, AnSDFPrimitiveThatIsNotFiniteIsRefusedByName)
{
    SceneFile scene;
    scene.entities = {primitive("sound", 0, 0), primitive("ghost", 1, 0)};
    scene.entities[1].sdfPrimitive->radius = std::numeric_limits<float>::quiet_NaN();
    World world;
    Assets assets;
    populate(world, assets, scene);
    FrameView view;
    try {
        extract(world, assets, view);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.which, "ghost");
    }
}

TEST(Extract, BonesAreAFieldOfLightsAlone)
{
    Stage stage;
    stage.assets.capsules = {{}, {0, {1, 0, 0}, {1, 2, 0}, 0.5f}, {0, {0, 0, 0}, {0, 0, 1}, 0.25f}};
    Entity character;
    for (auto [entity, matrix] : Each<Entity, const WorldMatrix, ecs::With<DynamicSkinned>>(stage.world))
        if (vec3(matrix.now[3]) == vec3(4, 5, 6))
            character = entity;
    stage.world.add(character, SDFPrimitive{.shape = SDFShape::Bones});
    stage.world.add(character, FieldCapsules{1, 2});
    extract(stage.world, stage.assets, stage.view);
    EXPECT_TRUE(stage.view.boneSteps.empty()) << "there is no light";

    stage.world.create(AreaLight{}, LightBodies{}, WorldMatrix{});
    extract(stage.world, stage.assets, stage.view);
    EXPECT_TRUE(stage.view.fieldSteps.empty());
    ASSERT_EQ(stage.view.boneSteps.size(), 2u);
    EXPECT_EQ(stage.view.boneSteps[0].flags, shader::kFieldBegins);
    EXPECT_EQ(stage.view.boneSteps[1].flags, 0u);
    expectNear(render::boundOf(stage.view.boneSteps[0]).centre, {5, 6, 6});
    EXPECT_NEAR(render::boundOf(stage.view.boneSteps[0]).radius, 1.5f, 1e-5f);
}

TEST(Extract, SteadyFramesAllocateNothing)
{
    Stage stage;
    extract(stage.world, stage.assets, stage.view);
    const uint64_t before = test::allocationCount();
    for (int frame = 0; frame < 300; ++frame)
        extract(stage.world, stage.assets, stage.view);
    EXPECT_EQ(test::allocationCount(), before);
}

} // namespace
