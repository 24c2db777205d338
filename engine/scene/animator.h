// Characters in motion: time in clips, cross-fades, and the joint matrices and morph weights that come of them.
// Chooses no clips and skins no vertices.
#pragma once

#include "ecs/schedule.h"
#include "scene/animation.h"
#include "scene/assets.h"
#include "scene/components.h"

namespace antumbra::scene {

/// A resource: the poses of all characters, each in a slot of its own. A slot is given again only to a character of the same size,
/// so the ranges in a Pose never move.
class PoseStore
{
public:
    /// A slot for `owner`, posed as the animator says.
    Pose give(ecs::Entity owner, const Animator& animator, const Model& model);
    /// Frees the slots of the owners that `isGone` is true of; it is asked once for every slot in use.
    template <class Predicate>
    void takeBack(Predicate isGone);

    [[nodiscard]] std::span<const mat4> joints(const Pose& pose) const { return {&joints_[pose.firstJoint], pose.jointCount}; }
    [[nodiscard]] std::span<const float> morphWeights(const Pose& pose) const;

    /// Makes the pose what the animator says; its version changes exactly when a matrix or a weight does.
    void update(Pose& pose, const Animator& animator, const Model& model);

private:
    struct Slot
    {
        ecs::Entity owner; // null: free
        Pose pose;         // as it was given
    };

    Pose& findFreeSlot(ecs::Entity owner, const Model& model);

    std::vector<Slot> slots_;
    std::vector<mat4> joints_;
    std::vector<float> morphWeights_;
    // Worked out here before it is compared: kept for the memory.
    LocalPose local_;
    LocalPose faded_;
    std::vector<mat4> resolved_;
    std::vector<mat4> nodeToModel_;
    uint64_t newestVersion_ = 0;
};

/// A system, before animate(): gives a Pose to who became a character, as its Animator says or at rest, and takes it from who is none
/// any more. A newcomer moves from the next step on.
void assignPoses(
    ecs::Each<ecs::Entity, const Drawable, ecs::Maybe<const Animator>, ecs::With<DynamicSkinned>, ecs::Without<Pose>> newcomers,
    ecs::Each<const Pose, ecs::With<Drawable>, ecs::With<DynamicSkinned>> characters, ecs::Commands commands, const Assets& assets,
    PoseStore& poses);

/// A system: clips advance by speed times `step`, which may run backwards, loop, and cross-fade.
/// One long step gives the pose that many short ones give, so a still picture at a time takes one call.
void animate(ecs::Each<Animator, Pose, const Drawable> characters, const Assets& assets, PoseStore& poses, ecs::Seconds step);

/// Fades to `clip` (of the model, or kNoIndex) within `fadeSeconds`, from its start; 0 cuts. What plays already plays on. A fade that is
/// under way turns back where `clip` is what it came from, and is cut short otherwise.
void play(Animator& animator, uint32_t clip, float fadeSeconds);

template <class Predicate>
void PoseStore::takeBack(Predicate isGone)
{
    for (Slot& slot : slots_)
        if (slot.owner && isGone(slot.owner))
            slot.owner = {};
}

} // namespace antumbra::scene
