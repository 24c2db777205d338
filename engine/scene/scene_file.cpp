#include "scene/scene_file.h"

#include "base/error.h"
#include "scene/hierarchy.h"
#include "scene/scene_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace antumbra::scene {

namespace {

/// What an entity says about its copies.
struct Repeat
{
    int32_t count = 1;
    int32_t columns = 1;
    vec2 spacing{1}; // metres along X and Z
    float turnRadians = 0;
    float offsetSeconds = 0;
    std::vector<std::string> clips;
};

/// The value of a setting: the last of the overrides, else the last in the scene.
const std::string* findSetting(std::string_view key, const Settings& settings, const Settings& overrides)
{
    for (const Settings* list : {&overrides, &settings}) {
        const auto found = std::find_if(list->rbegin(), list->rend(), [key](const auto& setting) { return setting.first == key; });
        if (found != list->rend())
            return &found->second;
    }
    return nullptr;
}

int32_t readCount(const JsonObject& part, const Settings& settings, const Settings& overrides)
{
    if (part.isNumber("count"))
        return part.integer("count", 1, {0, kGreatestRepeat});
    const std::string key = part.text("count", "");
    const std::string* value = findSetting(key, settings, overrides);
    if (value == nullptr)
        part.refuse("count", fmt::format("expected a number, or a setting of the scene; \"{}\" is none", key));
    int32_t count = 0;
    const auto [end, failure] = std::from_chars(value->data(), value->data() + value->size(), count);
    if (failure != std::errc() || end != value->data() + value->size() || count < 0 || count > kGreatestRepeat)
        part.refuse("count", fmt::format("{}={}: expected an integer from 0 to {}", key, *value, kGreatestRepeat));
    return count;
}

Repeat readRepeat(const JsonObject& part, const Settings& settings, const Settings& overrides)
{
    part.allowOnly({"count", "grid", "columns", "turn_deg", "offset", "clips"});
    Repeat repeat;
    repeat.count = readCount(part, settings, overrides);
    const auto squareSide = static_cast<int32_t>(std::ceil(std::sqrt(static_cast<float>(repeat.count))));
    repeat.columns = part.integer("columns", squareSide, {1, kGreatestRepeat});
    repeat.spacing = part.vector("grid", repeat.spacing, kAnyLength);
    repeat.turnRadians = glm::radians(part.number("turn_deg", 0, kAnyDegrees));
    repeat.offsetSeconds = part.number("offset", 0, {0, 1000});
    repeat.clips = part.texts("clips");
    return repeat;
}

/// Whether every setting that the entity depends on has the value it asks for.
bool isAskedFor(const JsonObject& condition, const Settings& settings, const Settings& overrides)
{
    bool isAsked = true;
    for (const auto& [key, wanted] : condition.pairs()) {
        const std::string* value = findSetting(key, settings, overrides);
        if (value == nullptr)
            condition.refuse(key, "is no setting of the scene");
        isAsked = isAsked && *value == wanted;
    }
    return isAsked;
}

SceneEntity copyOf(const SceneEntity& entity, const Repeat& repeat, int32_t index)
{
    SceneEntity copy = entity;
    const int32_t rows = (repeat.count + repeat.columns - 1) / repeat.columns;
    const int32_t columns = std::min(repeat.columns, repeat.count);
    const vec2 cell(index % repeat.columns, index / repeat.columns);
    const vec2 fromCentre = repeat.spacing * (cell - 0.5f * vec2(columns - 1, rows - 1));
    copy.transform.position += vec3(fromCentre.x, 0, fromCentre.y);
    copy.transform.rotation = glm::angleAxis(repeat.turnRadians * static_cast<float>(index), vec3(0, 1, 0)) * entity.transform.rotation;
    if (!entity.name.empty())
        copy.name = fmt::format("{}.{}", entity.name, index);
    if (!repeat.clips.empty()) {
        copy.animation = entity.animation.value_or(SceneAnimation{});
        copy.animation->clip = repeat.clips[static_cast<size_t>(index) % repeat.clips.size()];
    }
    if (copy.animation)
        copy.animation->offsetSeconds += repeat.offsetSeconds * static_cast<float>(index);
    return copy;
}

SceneMesh readMesh(const JsonObject& part, const Path& folder)
{
    if (!part.has("mesh"))
        return {};
    const std::string value = part.text("mesh", "");
    if (const Path file = value; file.extension() == ".glb" || file.extension() == ".gltf")
        return {MeshKind::File, folder / file};
    constexpr Words<MeshKind, 6> kMeshes{{{"plane", MeshKind::Plane},
                                          {"cube", MeshKind::Cube},
                                          {"sphere", MeshKind::Sphere},
                                          {"disk", MeshKind::Disk},
                                          {"icosphere", MeshKind::Icosphere},
                                          {"frustum", MeshKind::Frustum}}};
    return {part.choice<MeshKind>("mesh", std::nullopt, kMeshes), {}};
}

bool readMarker(const JsonObject& part, std::string_view key)
{
    if (part.has(key))
        part.object(key).allowOnly({});
    return part.has(key);
}

SceneEntity readEntity(const JsonObject& part, const Path& folder, std::vector<std::string>& fields)
{
    part.allowOnly({"name", "parent", "transform", "mesh", "material", "animation", "orbit", "repeat", "only_if", "StaticPRT",
                    "DynamicSkinned", "AreaLight", "Occluder", "SDFPrimitive"});
    SceneEntity entity;
    entity.name = part.text("name", "");
    entity.transform = readTransform(part.object("transform"));
    entity.mesh = readMesh(part, folder);
    if (part.has("material"))
        entity.material = readMaterial(part.object("material"));
    if (part.has("animation"))
        entity.animation = readAnimation(part.object("animation"));
    if (part.has("orbit"))
        entity.orbit = readOrbit(part.object("orbit"));
    entity.isStaticPRT = readMarker(part, "StaticPRT");
    entity.isDynamicSkinned = readMarker(part, "DynamicSkinned");
    if (part.has("AreaLight"))
        entity.areaLight = readAreaLight(part.object("AreaLight"));
    if (part.has("Occluder"))
        entity.occluder = readOccluder(part.object("Occluder"));
    if (part.has("SDFPrimitive"))
        entity.sdfPrimitive = readSDFPrimitive(part.object("SDFPrimitive"), fields);

    if (entity.isStaticPRT && entity.isDynamicSkinned)
        part.refuse("", "is both StaticPRT and DynamicSkinned");
    const bool isMeshLight = entity.areaLight && entity.areaLight->shape == LightShape::Mesh;
    const bool needsMesh = entity.animation || entity.occluder || isMeshLight;
    const bool needsShape = entity.isStaticPRT || entity.isDynamicSkinned || entity.material;
    if (entity.mesh.kind == MeshKind::None && (needsMesh || (needsShape && !entity.sdfPrimitive)))
        part.refuse("", "needs a \"mesh\"");
    return entity;
}

SceneCamera readCamera(const JsonObject& part)
{
    part.allowOnly({"position", "target", "vfov_deg"});
    SceneCamera camera;
    camera.position = part.vector("position", camera.position, kAnyLength);
    camera.target = part.vector("target", camera.target, kAnyLength);
    camera.verticalFovRadians = glm::radians(part.number("vfov_deg", glm::degrees(camera.verticalFovRadians), {1, 170}));
    if (glm::distance(camera.position, camera.target) < 1e-4f)
        part.refuse("target", "is where the camera stands");
    return camera;
}

SceneEnvironment readEnvironment(const JsonObject& part, const Path& folder)
{
    part.allowOnly({"file", "sky", "rotation_deg", "intensity"});
    if (part.has("file") == part.has("sky"))
        part.refuse("", "needs either \"file\" or \"sky\"");
    SceneEnvironment environment;
    if (part.has("file"))
        environment.file = folder / part.text("file", "");
    environment.sky = part.vectorOrNumber("sky", environment.sky, {0, 1e9f});
    environment.rotationRadians = glm::radians(part.number("rotation_deg", 0, kAnyDegrees));
    environment.intensity = part.number("intensity", 1, {0, 1e6f});
    return environment;
}

/// `parentNames` are as many as entities; a parent may stand further down than its children.
void resolveParents(std::vector<SceneEntity>& entities, const std::vector<std::string>& parentNames, const JsonObject& root)
{
    std::map<std::string_view, uint32_t> indexOf;
    for (const SceneEntity& entity : entities) {
        if (!entity.name.empty() && !indexOf.emplace(entity.name, &entity - entities.data()).second)
            root.refuse("entities", fmt::format("the name \"{}\" is not unique", entity.name));
    }
    for (size_t i = 0; i < entities.size(); ++i) {
        if (parentNames[i].empty())
            continue;
        const auto parent = indexOf.find(parentNames[i]);
        if (parent == indexOf.end())
            root.refuse("entities", fmt::format("no entity has the name \"{}\", which is given as a parent", parentNames[i]));
        entities[i].parent = parent->second;
    }
    for (const SceneEntity& entity : entities) {
        uint32_t depth = 0;
        for (uint32_t above = entity.parent; above != kNoIndex; above = entities[above].parent) {
            if (++depth > kGreatestDepth)
                root.refuse("entities",
                            fmt::format("the parents of \"{}\" run in a circle, or deeper than {}", entity.name, kGreatestDepth));
        }
    }
}

} // namespace

SceneFile loadScene(const Path& file, const Settings& overrides)
{
    const nlohmann::json document = parseJson(file);
    const JsonObject root(document, file, "");
    root.allowOnly({"camera", "environment", "settings", "entities"});
    const Path folder = file.parent_path();

    SceneFile scene;
    scene.file = file;
    scene.camera = readCamera(root.object("camera"));
    if (root.has("environment"))
        scene.environment = readEnvironment(root.object("environment"), folder);
    scene.settings = root.object("settings").pairs();
    std::vector<std::string> parentNames;
    for (const JsonObject& part : root.objects("entities")) {
        const SceneEntity entity = readEntity(part, folder, scene.fields);
        if (!isAskedFor(part.object("only_if"), scene.settings, overrides))
            continue;
        const std::string parentName = part.text("parent", "");
        const Repeat repeat = part.has("repeat") ? readRepeat(part.object("repeat"), scene.settings, overrides) : Repeat{};
        for (int32_t i = 0; i < repeat.count; ++i) {
            scene.entities.push_back(part.has("repeat") ? copyOf(entity, repeat, i) : entity);
            parentNames.push_back(parentName);
        }
    }
    resolveParents(scene.entities, parentNames, root);
    return scene;
}

SceneFile sceneOfModel(const Path& model, const Path& environment)
{
    SceneFile scene;
    scene.autoFrame = true;
    scene.environment = SceneEnvironment{.file = environment};
    SceneEntity ground{.name = "ground", .mesh = {MeshKind::Plane, {}}, .isStaticPRT = true};
    ground.material = Material{.albedo = vec3(0.5f), .specular = 0};
    ground.transform.scale = vec3(20, 1, 20);
    scene.entities.push_back(std::move(ground));
    SceneEntity shown{.name = "model", .mesh = {MeshKind::File, model}, .isDynamicSkinned = true};
    shown.animation.emplace();
    scene.entities.push_back(std::move(shown));
    return scene;
}

} // namespace antumbra::scene
