#include "scene/animator.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>

namespace antumbra::scene {

namespace {

float durationOf(const Model& model, uint32_t clip)
{
    check(clip == kNoIndex || clip < model.clips.size(), "a clip of the model");
    return clip == kNoIndex ? 0 : model.clips[clip].duration;
}

float looped(float seconds, float duration)
{
    if (duration <= 0)
        return 0;
    const float rest = std::fmod(seconds, duration);
    return rest < 0 ? rest + duration : rest;
}

bool isFading(const Animator& animator) { return animator.fadeElapsed < animator.fadeDuration; }

void advance(Animator& animator, const Model& model, float seconds)
{
    animator.time = looped(animator.time + animator.speed * seconds, durationOf(model, animator.clip));
    if (!isFading(animator))
        return;
    animator.previousTime = looped(animator.previousTime + animator.speed * seconds, durationOf(model, animator.previousClip));
    animator.fadeElapsed += seconds;
}

void setPose(LocalPose& pose, const Model& model, uint32_t clip, float seconds)
{
    setRest(pose, model);
    if (clip != kNoIndex)
        sample(pose, model.clips[clip], seconds);
}

} // namespace

std::span<const float> PoseStore::morphWeights(const Pose& pose) const
{
    return {morphWeights_.data() + pose.firstMorphWeight, pose.morphWeightCount};
}

Pose& PoseStore::findFreeSlot(ecs::Entity owner, const Model& model)
{
    const auto found = std::ranges::find_if(slots_, [&model](const Slot& slot) {
        return !slot.owner && slot.pose.jointCount == model.joints.size() && slot.pose.morphWeightCount == model.restMorphWeights.size();
    });
    if (found != slots_.end()) {
        found->owner = owner;
        return found->pose;
    }
    const Pose pose{.slot = static_cast<uint32_t>(slots_.size()),
                    .firstJoint = static_cast<uint32_t>(joints_.size()),
                    .jointCount = static_cast<uint32_t>(model.joints.size()),
                    .firstMorphWeight = static_cast<uint32_t>(morphWeights_.size()),
                    .morphWeightCount = static_cast<uint32_t>(model.restMorphWeights.size())};
    joints_.resize(joints_.size() + pose.jointCount);
    morphWeights_.resize(morphWeights_.size() + pose.morphWeightCount);
    return slots_.emplace_back(Slot{owner, pose}).pose;
}

Pose PoseStore::give(ecs::Entity owner, const Animator& animator, const Model& model)
{
    check(!model.joints.empty(), "a model with a joint");
    Pose& pose = findFreeSlot(owner, model);
    // What an earlier owner left may equal this pose: the version must differ all the same.
    pose.version = ++newestVersion_;
    update(pose, animator, model);
    return pose;
}

void PoseStore::update(Pose& pose, const Animator& animator, const Model& model)
{
    check(pose.jointCount == model.joints.size() && pose.morphWeightCount == model.restMorphWeights.size(), "a pose of the same model");
    setPose(local_, model, animator.clip, animator.time);
    if (isFading(animator)) {
        setPose(faded_, model, animator.previousClip, animator.previousTime);
        blend(local_, faded_, 1 - animator.fadeElapsed / animator.fadeDuration);
    }
    resolved_.resize(pose.jointCount);
    resolve(resolved_, nodeToModel_, local_, model);
    if (std::ranges::equal(resolved_, joints(pose)) && std::ranges::equal(local_.morphWeights, morphWeights(pose)))
        return;
    std::ranges::copy(resolved_, joints_.begin() + pose.firstJoint);
    std::ranges::copy(local_.morphWeights, morphWeights_.begin() + pose.firstMorphWeight);
    pose.version = ++newestVersion_;
}

void assignPoses(
    ecs::Each<ecs::Entity, const Drawable, ecs::Maybe<const Animator>, ecs::With<DynamicSkinned>, ecs::Without<Pose>> newcomers,
    ecs::Each<const Pose, ecs::With<Drawable>, ecs::With<DynamicSkinned>> characters, ecs::Commands commands, const Assets& assets,
    PoseStore& poses)
{
    poses.takeBack([&](ecs::Entity owner) {
        const bool isGone = !characters.find(owner);
        if (isGone)
            commands.remove<Pose>(owner);
        return isGone;
    });
    for (auto [entity, drawable, animator] : newcomers)
        commands.add(entity, poses.give(entity, animator != nullptr ? *animator : Animator{}, assets.models[drawable.model]));
}

void animate(ecs::Each<Animator, Pose, const Drawable> characters, const Assets& assets, PoseStore& poses, ecs::Seconds step)
{
    for (auto [animator, pose, drawable] : characters) {
        const Model& model = assets.models[drawable.model];
        advance(animator, model, step.value);
        poses.update(pose, animator, model);
    }
}

void play(Animator& animator, uint32_t clip, float fadeSeconds)
{
    if (clip == animator.clip)
        return;
    if (isFading(animator) && clip == animator.previousClip) {
        std::swap(animator.clip, animator.previousClip);
        std::swap(animator.time, animator.previousTime);
        animator.fadeElapsed = fadeSeconds * (1 - animator.fadeElapsed / animator.fadeDuration);
    } else {
        animator.previousClip = animator.clip;
        animator.previousTime = animator.time;
        animator.clip = clip;
        animator.time = 0;
        animator.fadeElapsed = 0;
    }
    animator.fadeDuration = fadeSeconds;
}

} // namespace antumbra::scene
