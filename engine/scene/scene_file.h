// A scene as its JSON file describes it (DESIGN.md, Commands), checked value by value: facts and paths. Opens no asset and makes
// no entity: models and images are found and loaded elsewhere.
#pragma once

#include "base/file.h"
#include "scene/components.h"
#include "scene/model.h"

#include <optional>
#include <utility>

namespace antumbra::scene {

/// Keys and values as text; a later one wins.
using Settings = std::vector<std::pair<std::string, std::string>>;

enum class MeshKind { None, Plane, Cube, Sphere, Disk, Icosphere, Frustum, File };

struct SceneMesh
{
    MeshKind kind = MeshKind::None;
    Path file; // .glb or .gltf
};

struct SceneAnimation
{
    std::string clip; // empty: the model's first
    float speed = 1;
    float offsetSeconds = 0;
};

struct SceneEntity
{
    std::string name; // unique, or empty
    Transform transform;
    uint32_t parent = kNoIndex; // into SceneFile::entities
    SceneMesh mesh;
    std::optional<Material> material; // in place of the mesh's own
    std::optional<SceneAnimation> animation;
    std::optional<Orbit> orbit; // about the transform's position
    bool isStaticPRT = false;
    bool isDynamicSkinned = false;
    std::optional<AreaLight> areaLight;
    std::optional<Occluder> occluder;
    std::optional<SDFPrimitive> sdfPrimitive;
};

struct SceneCamera
{
    vec3 position{0, 1.6f, 5};
    vec3 target{0, 1, 0};
    float verticalFovRadians = glm::radians(45.0f);
};

struct SceneEnvironment
{
    Path file;   // .hdr or .exr; empty: uniform `sky`
    vec3 sky{1}; // W/(m^2 sr)
    float rotationRadians = 0;
    float intensity = 1;
};

struct SceneFile
{
    Path file; // it was read from; empty for a scene that was made
    SceneCamera camera;
    bool autoFrame = false; // the camera is yet to be placed, and the ground to be sized, by what there is to see
    std::optional<SceneEnvironment> environment;
    Settings settings;                 // the scene's own, without the overrides
    std::vector<SceneEntity> entities; // repeated ones written out
    std::vector<std::string> fields;   // names of distance fields; SDFPrimitive::field is an index
};

/// The most copies that one "repeat" makes.
inline constexpr int32_t kGreatestRepeat = 256;

/// Paths in the file are relative to it, those returned are not. `overrides` come after the scene's settings and can size a crowd and
/// choose what there is: "only_if":{"KEY OF A SETTING":"VALUE"} on an entity leaves it out where the setting has another value, and
/// "repeat":{"count":N or the key of a setting, "grid":[dx,dz], "columns":N, "turn_deg":D, "offset":S, "clips":[...]} on an entity writes
/// it out `count` times as NAME.0, NAME.1..., on a grid about its position that is square unless `columns` says otherwise, each copy
/// turned by D degrees about +Y and S seconds further into its clip than the one before, the clips taken in turn.
/// Throws Error, of one line, for what is not JSON and for an unknown key (with the nearest known), a wrong type, a value out of range.
SceneFile loadScene(const Path& file, const Settings& overrides = {});

/// A scene to look at one model in: dynamic, on a plane, under `environment`; autoFrame is set.
SceneFile sceneOfModel(const Path& model, const Path& environment);

} // namespace antumbra::scene
