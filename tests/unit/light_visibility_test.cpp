// Visibility of one light: which light a name means, what is drawn of a scene for it, and what is made of the two pictures.
#include "app/light_visibility.h"
#include "app/shadow_bodies.h"
#include "base/error.h"
#include "render/extract.h"
#include "scene/populate.h"

#include <gmock/gmock.h>

namespace antumbra::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

scene::SceneEntity lamp(const std::string& name, vec3 radiance = vec3(1))
{
    scene::SceneEntity entity{.name = name};
    entity.areaLight = scene::AreaLight{.radiance = radiance};
    return entity;
}

/// Two lamps, the second a cube that is its own occluder too.
struct Shop
{
    ecs::World world;
    scene::Assets assets;
    render::FrameView view;

    Shop()
    {
        scene::SceneFile scene;
        scene::SceneEntity box = lamp("box", vec3(0, 4, 8));
        box.mesh.kind = scene::MeshKind::Cube;
        box.areaLight->shape = scene::LightShape::Mesh;
        box.occluder.emplace();
        scene.environment = scene::SceneEnvironment{};
        scene.entities = {lamp("left"), box, scene::SceneEntity{.name = "nothing"}};
        populate(world, assets, scene);
        makeShadowBodies(world, assets, "scene.json");
        extract(world, assets, view);
    }
};

TEST(LightVisibility, AovsNameTheirLight)
{
    EXPECT_EQ(lightOfAov("visibility:left"), "left");
    EXPECT_EQ(lightOfAov("visibility:"), "");
    EXPECT_FALSE(lightOfAov("normal"));
}

TEST(LightVisibility, LightsAreFoundByName)
{
    const Shop shop;
    ASSERT_EQ(shop.view.areaLights.size(), 2u);
    EXPECT_EQ(shop.view.areaLights[lightNamed(shop.world, shop.view, "box")].radiance, vec3(0, 4, 8));
    EXPECT_NE(lightNamed(shop.world, shop.view, "left"), lightNamed(shop.world, shop.view, "box"));
    for (const char* name : {"nothing", "lef", ""}) {
        try {
            lightNamed(shop.world, shop.view, name);
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.which, name);
            EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("left"), HasSubstr("box")));
        }
    }
}

TEST(LightVisibility, TheViewHasThatLightAlone)
{
    const Shop shop;
    const uint32_t box = lightNamed(shop.world, shop.view, "box"), left = 1 - box;
    const render::FrameView ofBox = viewOfLight(shop.view, box), ofLeft = viewOfLight(shop.view, left);
    ASSERT_EQ(ofBox.areaLights.size(), 1u);
    EXPECT_EQ(ofBox.areaLights[0].radiance, vec3(0, 0.5f, 1));
    EXPECT_FALSE(ofBox.hasEnvironment());
    ASSERT_EQ(ofBox.occluders.size(), 1u);
    EXPECT_EQ(ofBox.occluders[0].light, 0u) << "it does not hide itself";
    EXPECT_EQ(ofLeft.occluders.at(0).light, scene::kNoIndex) << "it hides the other";
}

TEST(LightVisibility, SharesAreOfWhatWouldArrive)
{
    const scene::ImageF unshadowed{4, 1, 3, {2, 4, 2, 0, 1, 0, 0, 0, 0, 1, 1, 1}}, lit{4, 1, 3, {1, 2, 1, 0, 1.001f, 0, 0, 0, 0, 0, 0, 0}};
    EXPECT_THAT(shareOf(lit, unshadowed).values, ElementsAre(0.5f, 1, 0, 0));
}

} // namespace
} // namespace antumbra::app
