// What an entity of a scene can be: facts as plain values, no pointers, no GPU handles, no behaviour.
// Indices go into the assets loaded with the scene; kNoIndex (mesh.h) stands for none. Lengths are metres, angles radians.
#pragma once

#include "ecs/entity.h"
#include "scene/mesh.h"
#include "scene/shadow_components.h"

#include <string>

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
    uint32_t model = kNoIndex; // into Assets::models
};

/// Looks from its Transform's position.
struct Camera
{
    float verticalFovRadians = 0.8f;
    vec3 targetWorld{0};
    float nearMetres = 0.05f; // there is no far plane
};

struct Environment
{
    uint32_t image = kNoIndex; // into Assets::environments
    float rotationRadians = 0; // of the light about +Y, counter-clockwise seen from above
    float intensity = 1;
};

/// Plays `clip`, and fades from `previousClip` while fadeElapsed < fadeDuration. Clips are the model's, times seconds;
/// kNoIndex is the rest pose.
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

/// Where PoseStore (animator.h) keeps the matrices and weights of a DynamicSkinned entity.
struct Pose
{
    uint32_t slot = 0; // the entity's as long as it lives
    uint32_t firstJoint = 0;
    uint32_t jointCount = 0; // one a joint of the model
    uint32_t firstMorphWeight = 0;
    uint32_t morphWeightCount = 0;
    uint64_t version = 0; // differs exactly when the pose does, and is never another slot's
};

/// Circles about `centre`, in the plane of the parent's XZ.
struct Orbit
{
    vec3 centre{0};
    float radius = 0.5f;
    float radiansPerSecond = 1; // counter-clockwise seen from above
    float radians = 0;          // where it is
};

/// Does not move: its lighting by the environment is baked.
struct StaticPRT
{
};

/// Moves or deforms: its shadows are made each frame. A rigid mover is a skin of one joint.
struct DynamicSkinned
{
};

} // namespace antumbra::scene
