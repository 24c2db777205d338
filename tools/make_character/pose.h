// A posture of the skeleton: joints turned against their bind pose, legs set by where the feet stand (two-bone inverse
// kinematics), arms by where they point.
#pragma once

#include "tools/make_character/skeleton.h"

namespace antumbra::character {

struct Pose
{
    dvec3 hips{0};                            // model space
    std::array<dquat, kJointCount> rotations; // local

    Pose();
};

/// Right-handed turn about an axis of the parent, radians.
dquat turnX(double radians);
dquat turnY(double radians);
dquat turnZ(double radians);

struct FootTarget
{
    dvec3 ankle{0};             // model space
    dquat rotation{1, 0, 0, 0}; // model space, against the bind pose
    double toeBend = 0;         // radians, toes up against the foot
};

/// Sets hip, knee, ankle and toes; the knee points where the foot does. Returns how far the ankle was out of reach, metres.
double poseLeg(Pose& pose, Side side, const FootTarget& foot);

/// Unit directions in the chest's space, not parallel: the elbow bends from the one into the other.
void poseArm(Pose& pose, Side side, const dvec3& upper, const dvec3& lower);

} // namespace antumbra::character
