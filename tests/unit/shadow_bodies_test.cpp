#include "app/shadow_bodies.h"

#include "base/error.h"
#include "ecs/each.h"
#include "render/extract.h"
#include "scene/animator.h"
#include "scene/populate.h"

#include <gmock/gmock.h>

namespace antumbra::app {
namespace {

using scene::MeshKind;
using scene::SceneEntity;
using scene::SceneFile;

SceneEntity meshEntity(MeshKind kind, bool blocks)
{
    SceneEntity entity{.mesh = {kind, {}}};
    if (blocks)
        entity.occluder.emplace();
    return entity;
}

SceneEntity lamp(const scene::AreaLight& light, MeshKind kind = MeshKind::None)
{
    SceneEntity entity{.mesh = {kind, {}}};
    entity.areaLight = light;
    return entity;
}

struct Made
{
    ecs::World world;
    scene::Assets assets;

    explicit Made(std::vector<SceneEntity> entities)
    {
        SceneFile scene;
        scene.entities = std::move(entities);
        populate(world, assets, scene);
        makeShadowBodies(world, assets, "scene.json");
    }
    render::FrameView extracted() const
    {
        render::FrameView view;
        extract(world, assets, view);
        return view;
    }
};

TEST(ShadowBodies, LightsShineByBodiesOfTheirShape)
{
    const Made made({lamp({.shape = scene::LightShape::Quad}), lamp({.shape = scene::LightShape::Disk}),
                     lamp({.shape = scene::LightShape::Sphere}), lamp({.shape = scene::LightShape::Cylinder})});
    const render::FrameView view = made.extracted();
    ASSERT_EQ(view.areaLights.size(), 4u);
    EXPECT_TRUE(view.statics.empty()) << "what shines is no object";
    for (const render::AreaLightDraw& light : view.areaLights) {
        ASSERT_EQ(light.partCount, 1u);
        EXPECT_GT(made.assets.models[light.model].mesh.indices.size(), 0u);
    }
    EXPECT_EQ(made.assets.bodyParts[view.areaLights[0].firstPart].body.vertices.size(), 4u);
    EXPECT_FALSE(made.assets.bodyParts[view.areaLights[2].firstPart].body.isPlanar);
}

TEST(ShadowBodies, AMeshThatShinesIsNotDrawnAsAnObject)
{
    const Made made({lamp({.shape = scene::LightShape::Mesh}, MeshKind::Frustum), meshEntity(MeshKind::Cube, false)});
    const render::FrameView view = made.extracted();
    ASSERT_EQ(view.areaLights.size(), 1u);
    EXPECT_EQ(made.assets.bodyParts[view.areaLights[0].firstPart].body.faces.size(), 14u);
    EXPECT_EQ(view.statics.size(), 1u);
}

TEST(ShadowBodies, AConvexMeshBlocksAsItIsAndAnOpenOneByItsHull)
{
    const Made made({lamp({}), meshEntity(MeshKind::Cube, true), meshEntity(MeshKind::Plane, true)});
    const render::FrameView view = made.extracted();
    ASSERT_EQ(view.occluders.size(), 2u);
    const scene::BodyPart& cube = made.assets.bodyParts[view.occluders[0].part];
    EXPECT_EQ(cube.body.faces.size(), 6u);
    EXPECT_FALSE(cube.isHollow);
    const scene::BodyPart& plane = made.assets.bodyParts[view.occluders[1].part];
    EXPECT_TRUE(plane.body.isPlanar);
    EXPECT_FALSE(plane.isHollow) << "what is flat has no inside";
}

TEST(ShadowBodies, TrianglesBlockOneByOneWhereTheyAreAskedFor)
{
    SceneEntity cube = meshEntity(MeshKind::Cube, true);
    cube.occluder->shape = scene::OccluderShape::Triangles;
    EXPECT_EQ(Made({lamp({}), cube}).extracted().occluders.size(), 12u);
}

TEST(ShadowBodies, WithoutALightNothingBlocks) { EXPECT_TRUE(Made({meshEntity(MeshKind::Cube, true)}).extracted().occluders.empty()); }

TEST(ShadowBodies, WhatShinesDoesNotHideItself)
{
    SceneEntity other = lamp({}), both = lamp({.shape = scene::LightShape::Mesh}, MeshKind::Cube);
    both.occluder.emplace();
    const render::FrameView view = Made({other, both}).extracted();
    ASSERT_EQ(view.occluders.size(), 1u);
    ASSERT_LT(view.occluders[0].light, view.areaLights.size());
    EXPECT_EQ(view.areaLights[view.occluders[0].light].partCount, 1u);
    const uint32_t part = view.areaLights[view.occluders[0].light].firstPart;
    EXPECT_FALSE(Made({other, both}).assets.bodyParts[part].body.isPlanar);
}

TEST(ShadowBodies, WhatShinesHidesItselfWhereItIsToldTo)
{
    SceneEntity both = lamp({.shape = scene::LightShape::Mesh, .shadowsItself = true}, MeshKind::Cube);
    both.occluder.emplace();
    const render::FrameView view = Made({both}).extracted();
    ASSERT_EQ(view.occluders.size(), 1u);
    EXPECT_EQ(view.occluders[0].light, scene::kNoIndex);
}

TEST(ShadowBodies, CurvedLightsHaveAsManyFacesAsTheyAreToldTo)
{
    const Made made(
        {lamp({.shape = scene::LightShape::Sphere, .segments = 162}), lamp({.shape = scene::LightShape::Disk, .segments = 24})});
    const render::FrameView view = made.extracted();
    EXPECT_EQ(made.assets.bodyParts[view.areaLights[0].firstPart].body.vertices.size(), 162u);
    EXPECT_EQ(made.assets.bodyParts[view.areaLights[1].firstPart].body.vertices.size(), 24u);
}

TEST(ShadowBodies, ACharacterBlocksByHullsThatFollowItsJoints)
{
    SceneEntity walker{.mesh = {MeshKind::File, projectPath("assets") / "characters/walker.glb"}, .isDynamicSkinned = true};
    walker.animation = scene::SceneAnimation{.clip = "walk"};
    walker.occluder = scene::Occluder{.greatestVertices = 12};
    Made made({lamp({}), walker});
    const render::FrameView before = made.extracted();
    ASSERT_GE(before.occluders.size(), 10u);
    for (const render::OccluderDraw& occluder : before.occluders) {
        const scene::BodyPart& part = made.assets.bodyParts[occluder.part];
        EXPECT_LE(part.body.vertices.size(), 12u);
        EXPECT_NE(part.joint, scene::kNoIndex);
        EXPECT_GE(part.margin, 0);
        EXPECT_LT(part.margin, 0.15f) << "metres";
    }
    auto& poses = made.world.resource<scene::PoseStore>();
    animate(ecs::Each<scene::Animator, scene::Pose, const scene::Drawable>(made.world), made.assets, poses, ecs::Seconds{0.3});
    const render::FrameView after = made.extracted();
    ASSERT_EQ(after.occluders.size(), before.occluders.size());
    size_t moved = 0;
    for (size_t i = 0; i < after.occluders.size(); ++i)
        moved += after.occluders[i].world != before.occluders[i].world ? 1 : 0;
    EXPECT_GT(moved, after.occluders.size() / 2);
}

TEST(ShadowBodies, WhatCannotShineIsRefusedByNameOfTheScene)
{
    for (const SceneEntity& entity : {lamp({.shape = scene::LightShape::Mesh}), lamp({.shape = scene::LightShape::Mesh}, MeshKind::Sphere)})
    {
        try {
            const Made made({entity});
            ADD_FAILURE() << "it shines";
        } catch (const Error& error) {
            EXPECT_EQ(error.which, "scene.json");
        }
    }
}

} // namespace
} // namespace antumbra::app
