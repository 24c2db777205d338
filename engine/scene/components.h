// What an entity of a scene can be: facts as plain values, no pointers, no GPU handles, no behaviour.
// Indices go into the assets loaded with the scene; kNoIndex (mesh.h) stands for none. Lengths are metres, angles radians.
#pragma once

#include "base/math.h"
#include "ecs/entity.h"
#include "scene/mesh.h"

#include <optional>

namespace antumbra::scene {

struct Name
{
    std::string text;
};

/// In the space of the parent where there is one, else of the world.
struct Transform
{
    vec3 position{0};
    quat rotation{1, 0, 0, 0};
    vec3 scale{1};
};

struct Parent
{
    ecs::Entity entity;
};

/// Local to world, this frame and the one before: made from Transform and Parent by hierarchy.h.
struct WorldMatrix
{
    mat4 now{1};
    mat4 before{1};
};

struct Drawable
{
    uint32_t model = kNoIndex;
    uint32_t material = kNoIndex; // in place of all the model's own
};

/// Looks from its Transform's position.
struct Camera
{
    float verticalFovRadians = 0.8f;
    vec3 targetWorld{0};
};

struct Environment
{
    uint32_t image = kNoIndex; // kNoIndex: uniform `sky`
    vec3 sky{1};               // W/(m^2 sr)
    float rotationRadians = 0; // of the light about +Y, counter-clockwise seen from above
    float intensity = 1;
};

/// Plays `clip`, and fades from `previousClip` while fadeElapsed < fadeDuration. Clips are the model's, times seconds.
struct Animator
{
    uint32_t clip = kNoIndex;
    float time = 0;
    float speed = 1;
    uint32_t previousClip = kNoIndex;
    float previousTime = 0;
    float fadeDuration = 0;
    float fadeElapsed = 0;
};

/// Does not move: its lighting by the environment is baked.
struct StaticPRT
{
};

/// Moves or deforms: its shadows are made each frame. A rigid mover is a skin of one joint.
struct DynamicSkinned
{
};

enum class LightShape
{
    Quad,
    Disk,
    Sphere,
    Cylinder,
    Polygon,
    Mesh
};
enum class LightShadow
{
    None,
    Analytic,
    Triangles,
    Traced,
    Ratio,
    Article,
    TwoSided,
    Reference
};

/// Flat shapes lie in the local XZ plane and shine along +Y; a cylinder lies along Y; Mesh is the entity's own.
struct AreaLight
{
    static constexpr uint32_t kGreatestOutline = 32;

    LightShape shape = LightShape::Quad;
    vec2 size{1};                                 // Quad: edges along X and Z
    vec2 radii{0.5f};                             // Disk: along X and Z; Sphere, Cylinder: x
    float length = 1;                             // Cylinder
    std::array<vec2, kGreatestOutline> outline{}; // Polygon: convex, x and z
    uint32_t outlineCount = 0;
    vec3 radiance{1}; // W/(m^2 sr)
    bool isTwoSided = false;
    std::optional<LightShadow> shadow; // none: as the knob area.shadow says
};

enum class OccluderShape
{
    Hulls,
    Triangles
};

/// Takes part in analytic shadows.
struct Occluder
{
    OccluderShape shape = OccluderShape::Hulls;
    uint32_t greatestVertices = 32; // of one hull
};

enum class SDFShape
{
    Sphere,
    Box,
    RoundedBox,
    Torus,
    Capsule,
    Plane
};
enum class SDFOperation
{
    Union,
    Subtract,
    Intersect,
    SmoothUnion
};

/// One step in making the distance field `field`: steps run by `order`, equal ones as the scene lists them.
struct SDFPrimitive
{
    SDFShape shape = SDFShape::Sphere;
    vec3 centre{0};          // Capsule: one end
    vec3 end{0};             // Capsule: the other
    vec3 halfExtent{0.5f};   // Box, RoundedBox (without its rounding)
    vec3 direction{0, 1, 0}; // unit; Torus: axis, Plane: normal
    float radius = 0.5f;     // Sphere, Capsule, RoundedBox: rounding, Torus: major
    float minorRadius = 0.1f;
    float offset = 0; // Plane: along the normal
    SDFOperation operation = SDFOperation::Union;
    float blend = 0; // SmoothUnion: k
    int32_t order = 0;
    uint32_t field = 0; // into SceneFile::fields
};

} // namespace antumbra::scene
