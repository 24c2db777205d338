#include "render/extract.h"

#include "base/error.h"
#include "ecs/each.h"
#include "render/field_steps.h"
#include "scene/animator.h"

#include <algorithm>
#include <string>
#include <tuple>

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
    view.environment = {.image = scene::kNoIndex};
    for (auto [environment] : Each<const scene::Environment>(world)) {
        view.environment = {environment.image, environment.rotationRadians, environment.intensity};
        return;
    }
}

bool isEmpty(const scene::Assets& assets, const scene::Drawable& drawable) { return assets.models[drawable.model].mesh.indices.empty(); }

/// The mesh is the light's own body, and drawn as such.
bool isLightItself(const scene::AreaLight* light) { return light != nullptr && light->shape == scene::LightShape::Mesh; }

void extractStatics(const ecs::World& world, const scene::Assets& assets, FrameView& view)
{
    for (auto [drawable, matrix, baked, light] : Each<const scene::Drawable, const scene::WorldMatrix, ecs::Maybe<const scene::StaticPRT>,
                                                      ecs::Maybe<const scene::AreaLight>, ecs::Without<DynamicSkinned>>(world))
        if (!isEmpty(assets, drawable) && !isLightItself(light))
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

bool isScaledEvenly(const mat4& world)
{
    const vec3 lengths(glm::length(vec3(world[0])), glm::length(vec3(world[1])), glm::length(vec3(world[2])));
    const float greatest = std::max({lengths.x, lengths.y, lengths.z});
    return std::min({lengths.x, lengths.y, lengths.z}) > 0.999f * greatest;
}

void extractAreaLights(const ecs::World& world, FrameView& view)
{
    for (auto [light, bodies, matrix] : Each<const scene::AreaLight, const scene::LightBodies, const scene::WorldMatrix>(world))
        view.areaLights.push_back({.firstPart = bodies.first,
                                   .partCount = bodies.count,
                                   .model = bodies.model,
                                   .world = matrix.now,
                                   .radiance = light.radiance,
                                   .isTwoSided = light.isTwoSided,
                                   .isSphere = light.shape == scene::LightShape::Sphere && isScaledEvenly(matrix.now),
                                   .shadow = light.shadow});
}

/// The light that these are the bodies of.
uint32_t lightOf(const FrameView& view, const scene::LightBodies& bodies)
{
    const auto found = std::ranges::find(view.areaLights, bodies.first, &AreaLightDraw::firstPart);
    return static_cast<uint32_t>(found - view.areaLights.begin());
}

void extractOccluders(const ecs::World& world, const scene::Assets& assets, FrameView& view)
{
    if (view.areaLights.empty())
        return;
    const auto& poses = world.resource<PoseStore>();
    for (auto [bodies, matrix, pose, light, lit] : Each<const scene::OccluderBodies, const scene::WorldMatrix, ecs::Maybe<const Pose>,
                                                        ecs::Maybe<const scene::AreaLight>, ecs::Maybe<const scene::LightBodies>>(world))
    {
        const bool isSpared = light != nullptr && lit != nullptr && !light->shadowsItself;
        const uint32_t own = isSpared ? lightOf(view, *lit) : scene::kNoIndex;
        for (uint32_t part = bodies.first; part < bodies.first + bodies.count; ++part) {
            const uint32_t joint = assets.bodyParts[part].joint;
            const bool isPosed = pose != nullptr && joint != scene::kNoIndex;
            view.occluders.push_back({part, isPosed ? matrix.now * poses.joints(*pose)[joint] : matrix.now, own});
        }
    }
}

std::string nameOf(const scene::Name* name) { return name != nullptr ? name->text : "an entity without a name"; }

void extractFields(const ecs::World& world, FrameView& view)
{
    for (auto [primitive, material, matrix, name] :
         Each<const scene::SDFPrimitive, const scene::SDFMaterial, const scene::WorldMatrix, ecs::Maybe<const scene::Name>>(world))
    {
        if (primitive.shape == scene::SDFShape::Bones)
            continue;
        const std::optional<shader::FieldStepBlock> step = fieldStep(primitive, matrix.now);
        if (!step)
            throw Error("SDFPrimitive: a parameter or the transform is not finite, or flattens it", nameOf(name));
        const auto listed = static_cast<uint32_t>(view.fieldSteps.size());
        view.fieldSteps.push_back({.field = primitive.field,
                                   .order = primitive.order,
                                   .listed = listed,
                                   .step = *step,
                                   .surface = {material.albedo, material.roughness, material.metallic, material.specular}});
    }
    std::ranges::sort(view.fieldSteps, {}, [](const FieldStepDraw& draw) { return std::tuple(draw.field, draw.order, draw.listed); });
    for (size_t i = 0; i < view.fieldSteps.size(); ++i)
        if (i == 0 || view.fieldSteps[i].field != view.fieldSteps[i - 1].field)
            view.fieldSteps[i].step.flags |= shader::kFieldBegins;
}

void extractBones(const ecs::World& world, const scene::Assets& assets, FrameView& view)
{
    if (view.areaLights.empty())
        return;
    const auto& poses = world.resource<PoseStore>();
    for (auto [primitive, range, matrix, pose, name] :
         Each<const scene::SDFPrimitive, const scene::FieldCapsules, const scene::WorldMatrix, const Pose, ecs::Maybe<const scene::Name>>(
             world))
    {
        for (const scene::BoneCapsule& bone : std::span(assets.capsules).subspan(range.first, range.count)) {
            const scene::SDFPrimitive capsule{.shape = scene::SDFShape::Capsule,
                                              .centre = bone.a,
                                              .end = bone.b,
                                              .radius = bone.radius,
                                              .operation = primitive.operation,
                                              .blend = primitive.blend};
            std::optional<shader::FieldStepBlock> step = fieldStep(capsule, matrix.now * poses.joints(pose)[bone.joint]);
            if (!step)
                throw Error("SDFPrimitive: a bone's transform is not finite, or flattens it", nameOf(name));
            step->flags = &bone == &assets.capsules[range.first] ? shader::kFieldBegins : 0;
            view.boneSteps.push_back(*step);
        }
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
    extractAreaLights(world, view);
    extractOccluders(world, assets, view);
    extractFields(world, view);
    extractBones(world, assets, view);
}

} // namespace antumbra::render
