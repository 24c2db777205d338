#include "render/extract.h"

#include "ecs/each.h"
#include "scene/animator.h"

namespace antumbra::render {

namespace {

using ecs::Each;
using scene::DynamicSkinned;
using scene::Pose;
using scene::PoseStore;

/// Looks along `direction`, of any length, with +Y as nearly up as can be.
quat lookAlong(vec3 direction)
{
    const vec3 ahead = glm::normalize(direction);
    const bool isSteep = std::abs(ahead.y) > 0.999f;
    return glm::quatLookAt(ahead, isSteep ? vec3(0, 0, ahead.y > 0 ? 1 : -1) : vec3(0, 1, 0));
}

void extractCamera(const ecs::World& world, FrameView& view)
{
    for (auto [camera, transform] : Each<const scene::Camera, const scene::Transform>(world)) {
        const vec3 ahead = camera.targetWorld - transform.position;
        view.camera = {.eye = transform.position,
                       .rotation = glm::length(ahead) > 0 ? lookAlong(ahead) : transform.rotation,
                       .verticalFovRadians = camera.verticalFovRadians,
                       .nearMetres = camera.nearMetres};
        return;
    }
}

void extractEnvironment(const ecs::World& world, FrameView& view)
{
    for (auto [environment] : Each<const scene::Environment>(world)) {
        view.environment = {environment.image, environment.rotationRadians, environment.intensity};
        return;
    }
}

bool isEmpty(const scene::Assets& assets, const scene::Drawable& drawable) { return assets.models[drawable.model].mesh.indices.empty(); }

void extractStatics(const ecs::World& world, const scene::Assets& assets, FrameView& view)
{
    for (auto [drawable, matrix, baked] :
         Each<const scene::Drawable, const scene::WorldMatrix, ecs::Maybe<const scene::StaticPRT>, ecs::Without<DynamicSkinned>>(world))
        if (!isEmpty(assets, drawable))
            view.statics.push_back({drawable.model, matrix.now, baked != nullptr});
}

void extractCharacters(const ecs::World& world, const scene::Assets& assets, FrameView& view)
{
    const auto& poses = world.resource<PoseStore>();
    for (auto [drawable, matrix, pose] :
         Each<const scene::Drawable, const scene::WorldMatrix, const Pose, ecs::With<DynamicSkinned>>(world)) {
        if (isEmpty(assets, drawable))
            continue;
        view.characters.push_back({.slot = pose.slot,
                                   .model = drawable.model,
                                   .world = matrix.now,
                                   .firstJoint = static_cast<uint32_t>(view.joints.size()),
                                   .firstMorphWeight = static_cast<uint32_t>(view.morphWeights.size()),
                                   .poseVersion = pose.version});
        const auto joints = poses.joints(pose);
        const auto morphWeights = poses.morphWeights(pose);
        view.joints.insert(view.joints.end(), joints.begin(), joints.end());
        view.morphWeights.insert(view.morphWeights.end(), morphWeights.begin(), morphWeights.end());
    }
}

} // namespace

void extract(const ecs::World& world, const scene::Assets& assets, FrameView& view)
{
    view.clear();
    extractCamera(world, view);
    extractEnvironment(world, view);
    extractStatics(world, assets, view);
    extractCharacters(world, assets, view);
}

} // namespace antumbra::render
