#include "scene/scene_file.h"

#include "base/error.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace antumbra;
using namespace antumbra::scene;

const TestFolder& folder()
{
    static const TestFolder folder;
    return folder;
}

Path fileWith(const std::string& text)
{
    const Path file = folder() / "scene.json";
    writeText(file, text);
    return file;
}

SceneFile load(const std::string& text, const Settings& overrides = {}) { return loadScene(fileWith(text), overrides); }

SceneEntity loadEntity(const std::string& entity) { return load(R"({"entities":[)" + entity + "]}").entities.at(0); }

/// The error's line, or nothing where the text is accepted.
std::string faultOf(const std::string& text, const Settings& overrides = {})
{
    try {
        load(text, overrides);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string faultOfEntity(const std::string& entity) { return faultOf(R"({"entities":[)" + entity + "]}"); }

void expectFault(const std::string& fault, const std::vector<std::string>& parts)
{
    for (const std::string& part : parts)
        EXPECT_NE(fault.find(part), std::string::npos) << "\"" << part << "\" is not in: " << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
}

TEST(SceneFile, ReadsCameraEnvironmentAndSettings)
{
    const SceneFile scene = load(R"({
        "camera": {"position": [1, 2, 3], "target": [0, 1, 0], "vfov_deg": 60},
        "environment": {"file": "../environments/hall.hdr", "rotation_deg": 90, "intensity": 2},
        "settings": {"occlusion.samples": 128, "occlusion.culling": "bones", "occlusion.scale": 0.5}})");
    EXPECT_EQ(scene.camera.position, vec3(1, 2, 3));
    EXPECT_NEAR(scene.camera.verticalFovRadians, kPi / 3, 1e-6f);
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->file, folder() / "../environments/hall.hdr");
    EXPECT_NEAR(scene.environment->rotationRadians, kPi / 2, 1e-6f);
    EXPECT_EQ(scene.environment->intensity, 2);
    const Settings expected{{"occlusion.culling", "bones"}, {"occlusion.samples", "128"}, {"occlusion.scale", "0.5"}};
    EXPECT_EQ(scene.settings, expected);
    EXPECT_FALSE(scene.autoFrame);
}

TEST(SceneFile, AnEmptySceneHasNothing)
{
    const SceneFile scene = load("{}");
    EXPECT_FALSE(scene.environment);
    EXPECT_TRUE(scene.entities.empty());
    EXPECT_TRUE(scene.settings.empty());
}

TEST(SceneFile, ReadsAnEntity)
{
    const SceneEntity entity = loadEntity(R"({"name": "walker", "mesh": "walker.glb", "DynamicSkinned": {},
        "transform": {"position": [1, 0, 0], "rotate_deg": [0, 90, 0], "scale": 2},
        "material": {"albedo": [0.1, 0.2, 0.3], "roughness": 0.4, "specular": 0},
        "animation": {"clip": "walk", "speed": 1.5, "offset": 0.25}})");
    EXPECT_EQ(entity.name, "walker");
    EXPECT_EQ(entity.mesh.kind, MeshKind::File);
    EXPECT_EQ(entity.mesh.file, folder() / "walker.glb");
    EXPECT_TRUE(entity.isDynamicSkinned);
    EXPECT_FALSE(entity.isStaticPRT);
    EXPECT_EQ(entity.transform.scale, vec3(2));
    EXPECT_NEAR(glm::distance(entity.transform.rotation * vec3(0, 0, 1), vec3(1, 0, 0)), 0, 1e-6f);
    ASSERT_TRUE(entity.material);
    EXPECT_EQ(entity.material->albedo, vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(entity.material->specular, 0);
    ASSERT_TRUE(entity.animation);
    EXPECT_EQ(entity.animation->clip, "walk");
    EXPECT_EQ(entity.animation->speed, 1.5f);
    EXPECT_EQ(entity.animation->offsetSeconds, 0.25f);
}

TEST(SceneFile, QuaternionsAreXyzwAndNormalised)
{
    const quat rotation = loadEntity(R"({"transform": {"rotation": [0, 2, 0, 2]}})").transform.rotation;
    EXPECT_NEAR(rotation.y, std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(rotation.w, std::sqrt(0.5f), 1e-6f);
}

TEST(SceneFile, RotationsAboutXComeFirst)
{
    const quat rotation = loadEntity(R"({"transform": {"rotate_deg": [90, 90, 0]}})").transform.rotation;
    EXPECT_NEAR(glm::distance(rotation * vec3(0, 1, 0), vec3(1, 0, 0)), 0, 1e-6f); // +Y to +Z about X, +Z to +X about Y
}

TEST(SceneFile, ReadsEveryAreaLight)
{
    const AreaLight quad = *loadEntity(R"({"AreaLight": {"shape": "quad", "size": [2, 3], "radiance": [4, 5, 6],
                                           "two_sided": true, "shadow": "two-sided"}})")
                                .areaLight;
    EXPECT_EQ(quad.size, vec2(2, 3));
    EXPECT_EQ(quad.radiance, vec3(4, 5, 6));
    EXPECT_TRUE(quad.isTwoSided);
    EXPECT_EQ(quad.shadow, LightShadow::TwoSided);

    EXPECT_EQ(loadEntity(R"({"AreaLight": {"shape": "disk", "radius": [1, 2]}})").areaLight->radii, vec2(1, 2));
    EXPECT_EQ(loadEntity(R"({"AreaLight": {"shape": "disk", "radius": 3}})").areaLight->radii, vec2(3));
    EXPECT_EQ(loadEntity(R"({"AreaLight": {"shape": "sphere", "radius": 3}})").areaLight->shape, LightShape::Sphere);
    EXPECT_EQ(loadEntity(R"({"AreaLight": {"shape": "cylinder", "radius": 1, "length": 7}})").areaLight->length, 7);
    const AreaLight polygon = *loadEntity(R"({"AreaLight": {"shape": "polygon", "vertices": [[0, 0], [1, 0], [1, 1]]}})").areaLight;
    EXPECT_EQ(polygon.outlineCount, 3u);
    EXPECT_EQ(polygon.outline[2], vec2(1, 1));
    EXPECT_FALSE(polygon.shadow);
    const AreaLight mesh = *loadEntity(R"({"mesh": "cube", "AreaLight": {"shape": "mesh", "self_shadow": true}})").areaLight;
    EXPECT_EQ(mesh.shape, LightShape::Mesh);
    EXPECT_TRUE(mesh.shadowsItself);
    EXPECT_FALSE(quad.shadowsItself);
    EXPECT_EQ(loadEntity(R"({"AreaLight": {"shape": "sphere", "radius": 3, "segments": 162}})").areaLight->segments, 162u);
}

TEST(SceneFile, ReadsOccludersAndDistanceFields)
{
    const SceneFile scene = load(R"({"entities": [
        {"mesh": "cube", "Occluder": {"shape": "hulls", "max_vertices": 12, "hulls_by": "piece"}},
        {"mesh": "cube", "Occluder": {"shape": "triangles"}},
        {"SDFPrimitive": {"shape": "torus", "center": [1, 2, 3], "axis": [0, 0, 2], "major": 2, "minor": 0.5, "field": "rings"}},
        {"SDFPrimitive": {"shape": "capsule", "a": [0, 0, 0], "b": [0, 1, 0], "radius": 0.2, "operation": "smooth_union", "k": 0.3,
                          "order": -4, "field": "rings"}},
        {"SDFPrimitive": {"shape": "plane", "normal": [0, 1, 0], "offset": -1, "operation": "subtract"}},
        {"SDFPrimitive": {"shape": "rounded_box", "half": [1, 2, 3], "radius": 0.1}},
        {"SDFPrimitive": {"shape": "cylinder", "center": [1, 2, 3], "axis": [0, 0, 3], "radius": 0.2, "height": 5}},
        {"SDFPrimitive": {"shape": "cone", "radius": 0.4, "height": 3}},
        {"SDFPrimitive": {"shape": "cone", "radius": 0.4, "top_radius": 0.3, "height": 3}}]})");
    EXPECT_EQ(scene.entities[0].occluder->greatestVertices, 12u);
    EXPECT_TRUE(scene.entities[0].occluder->isByPiece);
    EXPECT_EQ(scene.entities[1].occluder->shape, OccluderShape::Triangles);
    const SDFPrimitive& torus = *scene.entities[2].sdfPrimitive;
    EXPECT_EQ(torus.direction, vec3(0, 0, 1));
    EXPECT_EQ(torus.radius, 2);
    EXPECT_EQ(torus.minorRadius, 0.5f);
    const SDFPrimitive& capsule = *scene.entities[3].sdfPrimitive;
    EXPECT_EQ(capsule.operation, SDFOperation::SmoothUnion);
    EXPECT_EQ(capsule.blend, 0.3f);
    EXPECT_EQ(capsule.order, -4);
    EXPECT_EQ(capsule.field, torus.field);
    EXPECT_NE(scene.entities[4].sdfPrimitive->field, torus.field);
    EXPECT_EQ(scene.entities[5].sdfPrimitive->halfExtent, vec3(1, 2, 3));
    const SDFPrimitive& cylinder = *scene.entities[6].sdfPrimitive;
    EXPECT_EQ(cylinder.shape, SDFShape::Cylinder);
    EXPECT_EQ(cylinder.direction, vec3(0, 0, 1));
    EXPECT_EQ(cylinder.height, 5);
    const SDFPrimitive& cone = *scene.entities[7].sdfPrimitive;
    EXPECT_EQ(cone.radius, 0.4f);
    EXPECT_EQ(cone.minorRadius, 0) << "a cone has a tip";
    EXPECT_EQ(scene.entities[8].sdfPrimitive->minorRadius, 0.3f);
    EXPECT_EQ(scene.fields, (std::vector<std::string>{"rings", ""}));
}

TEST(SceneFile, BonesAreAFieldOfTheirOwn)
{
    const SDFPrimitive bones = *loadEntity(R"({"SDFPrimitive": {"shape": "bones", "operation": "smooth_union", "k": 0.05}})").sdfPrimitive;
    EXPECT_EQ(bones.shape, SDFShape::Bones);
    EXPECT_EQ(bones.blend, 0.05f);
    EXPECT_THROW(loadEntity(R"({"SDFPrimitive": {"shape": "bones", "operation": "subtract"}})"), Error);
    EXPECT_THROW(loadEntity(R"({"SDFPrimitive": {"shape": "bones", "field": "others"}})"), Error);
}

constexpr const char* kCrowd = R"({"settings": {"crowd.count": 10}, "entities": [
    {"name": "walker", "mesh": "walker.glb", "DynamicSkinned": {}, "transform": {"position": [0, 0, -5]}, "animation": {"clip": "idle"},
     "repeat": {"count": "crowd.count", "grid": [2, 3], "offset": 0.5, "turn_deg": 90, "clips": ["idle", "walk"]}}]})";

TEST(SceneFile, WritesRepeatedEntitiesOut)
{
    const SceneFile scene = load(kCrowd);
    ASSERT_EQ(scene.entities.size(), 10u);
    vec3 sum{0};
    std::set<std::pair<float, float>> places;
    for (const SceneEntity& entity : scene.entities) {
        EXPECT_EQ(entity.transform.position.y, 0);
        sum += entity.transform.position;
        places.emplace(entity.transform.position.x, entity.transform.position.z);
    }
    EXPECT_EQ(places.size(), 10u);
    EXPECT_EQ(scene.entities[0].name, "walker.0");
    EXPECT_EQ(scene.entities[9].name, "walker.9");
    EXPECT_EQ(scene.entities[0].transform.position, vec3(-3, 0, -8)); // first of four columns and three rows
    EXPECT_EQ(scene.entities[5].transform.position, vec3(-1, 0, -5));
    EXPECT_EQ(scene.entities[3].animation->clip, "walk");
    EXPECT_EQ(scene.entities[4].animation->clip, "idle");
    EXPECT_EQ(scene.entities[4].animation->offsetSeconds, 2);
    EXPECT_NEAR(glm::distance(scene.entities[1].transform.rotation * vec3(0, 0, 1), vec3(1, 0, 0)), 0, 1e-6f);
}

TEST(SceneFile, OverridesSizeACrowd)
{
    EXPECT_EQ(load(kCrowd, {{"crowd.count", "200"}}).entities.size(), 200u);
    EXPECT_EQ(load(kCrowd, {{"crowd.count", "7"}, {"crowd.count", "1"}}).entities.size(), 1u);
    EXPECT_TRUE(load(kCrowd, {{"crowd.count", "0"}}).entities.empty());
    for (const char* wrong : {"-1", "257", "-3", "ten", "", "10.5", "99999999999"})
        expectFault(faultOf(kCrowd, {{"crowd.count", wrong}}), {"entities[0].repeat.count", "crowd.count", "0 to 256"});
    expectFault(faultOfEntity(R"({"repeat": {"count": "crowd.size"}})"), {"crowd.size"});
}

TEST(SceneFile, SettingsChooseWhatThereIs)
{
    constexpr const char* kChoice = R"({"settings": {"gallery.light": "plane"}, "entities": [
        {"name": "flat", "only_if": {"gallery.light": "plane"}}, {"name": "round", "only_if": {"gallery.light": "cone"}}, {"name": "floor"}]})";
    const SceneFile scene = load(kChoice), other = load(kChoice, {{"gallery.light", "cone"}});
    ASSERT_EQ(scene.entities.size(), 2u);
    EXPECT_EQ(scene.entities[0].name, "flat");
    ASSERT_EQ(other.entities.size(), 2u);
    EXPECT_EQ(other.entities[0].name, "round");
    expectFault(faultOfEntity(R"({"only_if": {"gallery.light": "cone"}})"), {"only_if", "gallery.light"});
}

TEST(SceneFile, ParentsAreFoundByNameInAnyOrder)
{
    const SceneFile scene = load(R"({"entities": [{"parent": "b"}, {"name": "b"}]})");
    EXPECT_EQ(scene.entities[0].parent, 1u);
    EXPECT_EQ(scene.entities[1].parent, kNoIndex);
    expectFault(faultOf(R"({"entities": [{"parent": "c"}]})"), {"\"c\"", "parent"});
    expectFault(faultOf(R"({"entities": [{"name": "a", "parent": "b"}, {"name": "b", "parent": "a"}]})"), {"circle"});
    expectFault(faultOf(R"({"entities": [{"name": "a", "parent": "a"}]})"), {"circle"});
    expectFault(faultOf(R"({"entities": [{"name": "a"}, {"name": "a"}]})"), {"\"a\"", "not unique"});
}

TEST(SceneFile, UnknownKeysNameTheNearestKnownOne)
{
    expectFault(faultOf(R"({"entites": []})"), {"scene.json", "\"entites\"", "\"entities\""});
    expectFault(faultOf(R"({"camera": {"vfov": 60}})"), {"camera", "\"vfov\"", "\"vfov_deg\""});
    expectFault(faultOfEntity(R"({"transform": {"postion": [0, 0, 0]}})"), {"entities[0].transform", "\"postion\"", "\"position\""});
    expectFault(faultOfEntity(R"({"Dynamicskinned": {}})"), {"\"DynamicSkinned\""});
    expectFault(faultOfEntity(R"({"mesh": "cube", "StaticPRT": {"bake": 1}})"), {"entities[0].StaticPRT", "\"bake\""});
    expectFault(faultOfEntity(R"({"AreaLight": {"shape": "quad", "radius": 1}})"), {"AreaLight", "\"radius\""});
    expectFault(faultOfEntity(R"({"AreaLight": {"shape": "disk", "segments": 49}})"), {"AreaLight", "segments"});
    expectFault(faultOfEntity(R"({"AreaLight": {"shape": "sqare"}})"), {"\"sqare\"", "the nearest is"});
    expectFault(faultOfEntity(R"({"mesh": "spere"})"), {"\"spere\"", "\"sphere\""});
    expectFault(faultOfEntity(R"({"AreaLight": {}})"), {"\"shape\"", "quad"});
}

TEST(SceneFile, ValuesHaveTypesAndRanges)
{
    for (const char* entity : {R"({"transform": {"position": [0, 0]}})",
                               R"({"transform": {"position": [0, 0, "0"]}})",
                               R"({"transform": {"position": [0, 0, 1e300]}})",
                               R"({"transform": {"position": 3}})",
                               R"({"transform": {"rotation": [0, 0, 0, 0]}})",
                               R"({"transform": {"scale": 0}})",
                               R"({"transform": {"rotation": [0, 0, 0, 1], "rotate_deg": [0, 0, 0]}})",
                               R"({"transform": []})",
                               R"({"mesh": "cube", "material": {"albedo": [0, 0, 1.5]}})",
                               R"({"mesh": "cube", "material": {"roughness": -1}})",
                               R"({"material": {}})",
                               R"({"DynamicSkinned": {}})",
                               R"({"mesh": "cube", "StaticPRT": {}, "DynamicSkinned": {}})",
                               R"({"mesh": "cube", "StaticPRT": true})",
                               R"({"mesh": 7})",
                               R"({"name": 7})",
                               R"("walker")",
                               R"({"AreaLight": {"shape": "mesh"}})",
                               R"({"AreaLight": {"shape": "quad", "radiance": [-1, 0, 0]}})",
                               R"({"AreaLight": {"shape": "polygon", "vertices": [[0, 0], [1, 0]]}})",
                               R"({"AreaLight": {"shape": "polygon", "vertices": [[0, 0], [2, 0], [1, 0.2], [1, 2]]}})",
                               R"({"AreaLight": {"shape": "polygon", "vertices": [[0, 0], [1, 0], [2, 0]]}})",
                               R"({"SDFPrimitive": {"shape": "sphere", "k": 1}})",
                               R"({"SDFPrimitive": {"shape": "plane", "normal": [0, 0, 0]}})",
                               R"({"SDFPrimitive": {"shape": "sphere", "order": 1.5}})",
                               R"({"SDFPrimitive": {"shape": "cylinder", "top_radius": 1}})",
                               R"({"SDFPrimitive": {"shape": "cone", "top_radius": -1}})",
                               R"({"repeat": {"count": -1}})",
                               R"({"repeat": {"count": 1000000}})",
                               R"({"mesh": "cube", "Occluder": {"shape": "triangles", "max_vertices": 8}})"})
        expectFault(faultOfEntity(entity), {"entities[0]"});
    expectFault(faultOf(R"({"entities": {}})"), {"entities", "array"});
    expectFault(faultOf(R"({"settings": {"a": [1]}})"), {"settings.a"});
    expectFault(faultOf(R"({"environment": {}})"), {"\"file\" or \"sky\""});
    expectFault(faultOf(R"({"camera": {"position": [0, 1, 0], "target": [0, 1, 0]}})"), {"camera.target"});
    expectFault(faultOf("[]"), {"expected an object"});
}

TEST(SceneFile, TextThatIsNotJsonIsOneLineWithThePlace)
{
    expectFault(faultOf("{\n  \"camera\": {,}\n}"), {"scene.json", "line 2, column"});
    expectFault(faultOf(""), {"line 1"});
    expectFault(faultOf("{\"camera\": {\"vfov_deg\": 1e999}}"), {"1e999"});
    expectFault(faultOf("{\"a\": \"\xff\"}"), {"UTF-8"});
    expectFault(faultOf(std::string(200'000, '[')), {"line 1"});
    EXPECT_THROW(loadScene("/dev/zero"), Error);
    EXPECT_THROW(loadScene(folder() / "no_such_scene.json"), Error);
}

TEST(SceneFile, AModelByItselfStandsOnAPlane)
{
    const SceneFile scene = sceneOfModel("fox.glb", "hall.hdr");
    EXPECT_TRUE(scene.autoFrame);
    ASSERT_EQ(scene.entities.size(), 2u);
    EXPECT_EQ(scene.entities[0].mesh.kind, MeshKind::Plane);
    EXPECT_TRUE(scene.entities[0].isStaticPRT);
    EXPECT_EQ(scene.entities[1].mesh.file, Path("fox.glb"));
    EXPECT_TRUE(scene.entities[1].isDynamicSkinned);
    EXPECT_EQ(scene.environment->file, Path("hall.hdr"));
}

} // namespace
