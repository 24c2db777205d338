#include "game/camera_rig.h"

#include "game/player.h"

#include <algorithm>
#include <cmath>

namespace antumbra::game {

namespace {

constexpr float kLeastPitch = -0.05f; // radians: about level with the ground
constexpr float kGreatestPitch = 1.5f;
constexpr float kNearest = 0.3f; // of the distance at which the scene placed the camera
constexpr float kFarthest = 4;
constexpr float kDistanceANotch = 0.9f;
constexpr float kPursuitRate = 6;      // a second: the share of the way to the player
constexpr float kTurnPerMetre = 0.35f; // radians at most, while following

void orbit(CameraRig& rig, const app::InputFrame& input)
{
    rig.yaw = std::remainder(rig.yaw + input.look.x, 2 * kPi);
    // A camera that was placed lower may stay there.
    rig.pitch = std::clamp(rig.pitch + input.look.y, std::min(kLeastPitch, rig.pitch), kGreatestPitch);
    rig.distance =
        std::clamp(rig.distance * std::pow(kDistanceANotch, input.zoom), kNearest * rig.placedDistance, kFarthest * rig.placedDistance);
}

void pursue(CameraRig& rig, vec3 player)
{
    const vec3 way = (player + rig.targetFromPlayer - rig.target) * (1 - std::exp(-kPursuitRate * app::kStepSeconds));
    rig.target += way;
    const float walked = glm::length(vec2(way.x, way.z));
    if (!rig.isFollowing || walked == 0)
        return;
    // The sine lets the player walk towards the camera without being overtaken by it.
    const float behind = facingOf({-way.x, -way.z});
    rig.yaw += std::sin(angleBetween(rig.yaw, behind)) * std::min(kTurnPerMetre * walked, 0.1f);
}

} // namespace

CameraRig makeCameraRig(const scene::Transform& camera, vec3 target, vec3 player)
{
    const vec3 arm = camera.position - target;
    const float distance = std::max(glm::length(arm), 1e-3f);
    return {.yaw = facingOf({arm.x, arm.z}),
            .pitch = std::asin(std::clamp(arm.y / distance, -1.0f, 1.0f)),
            .distance = distance,
            .placedDistance = distance,
            .target = target,
            .targetFromPlayer = target - player};
}

void placeCamera(ecs::Each<scene::Camera, scene::Transform> cameras, ecs::Each<const scene::Transform, ecs::With<Player>> players,
                 const app::InputFrame& input, CameraRig& rig)
{
    if (input.asks(app::Action::ChangeCamera))
        rig.isFollowing = !rig.isFollowing;
    orbit(rig, input);
    for (auto [player] : players)
        pursue(rig, player.position);
    const vec3 arm{std::cos(rig.pitch) * std::sin(rig.yaw), std::sin(rig.pitch), std::cos(rig.pitch) * std::cos(rig.yaw)};
    for (auto [camera, transform] : cameras) {
        camera.targetWorld = rig.target;
        transform.position = rig.target + rig.distance * arm;
    }
}

} // namespace antumbra::game
