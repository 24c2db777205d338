#include "tools/make_character/pose.h"

#include <algorithm>
#include <cmath>

namespace antumbra::character {

namespace {

/// The rotation that takes +Y to `along` and +X as near to `hinge` as it goes.
dquat limbFrame(const dvec3& along, const dvec3& hinge)
{
    const dvec3 y = glm::normalize(along);
    const dvec3 x = glm::normalize(hinge - glm::dot(hinge, y) * y);
    return glm::quat_cast(dmat3(x, y, glm::cross(x, y)));
}

/// From the bind pose of the limb between two joints to the direction and hinge given.
dquat limbTurn(Joint from, Joint to, const dvec3& bindHinge, const dvec3& along, const dvec3& hinge)
{
    return limbFrame(along, hinge) * glm::inverse(limbFrame(bindOffset(from, to), bindHinge));
}

} // namespace

Pose::Pose() : hips(skeleton()[Hips].bind) { rotations.fill(dquat{1, 0, 0, 0}); }

dquat turnX(double radians) { return glm::angleAxis(radians, dvec3{1, 0, 0}); }
dquat turnY(double radians) { return glm::angleAxis(radians, dvec3{0, 1, 0}); }
dquat turnZ(double radians) { return glm::angleAxis(radians, dvec3{0, 0, 1}); }

double poseLeg(Pose& pose, Side side, const FootTarget& foot)
{
    const Joint upper = onSide(UpperLegLeft, side), lower = onSide(LowerLegLeft, side), ankle = onSide(FootLeft, side);
    const dquat& pelvis = pose.rotations[Hips];
    const dvec3 hip = pose.hips + pelvis * bindOffset(Hips, upper);
    const double thigh = glm::length(bindOffset(upper, lower)), shin = glm::length(bindOffset(lower, ankle));
    const double farthest = 0.9995 * (thigh + shin);

    const double wanted = glm::distance(foot.ankle, hip);
    const double reach = std::min(wanted, farthest);
    const dvec3 towards = (foot.ankle - hip) / wanted;
    const dvec3 ahead = glm::normalize(pelvis * dvec3{0, 0, 1} + foot.rotation * dvec3{0, 0.3, 1});
    const dvec3 hinge = glm::normalize(glm::cross(ahead, -towards)); // to the walker's left
    const double hipAngle = std::acos((thigh * thigh + reach * reach - shin * shin) / (2 * thigh * reach));
    const dvec3 thighAlong = glm::angleAxis(-hipAngle, -hinge) * towards;
    const dvec3 shinAlong = towards * reach - thighAlong * thigh;

    const dvec3 bindHinge{1, 0, 0};
    const dquat upperTurn = limbTurn(upper, lower, bindHinge, thighAlong, -hinge);
    const dquat lowerTurn = limbTurn(lower, ankle, bindHinge, shinAlong, -hinge);
    pose.rotations[upper] = glm::inverse(pelvis) * upperTurn;
    pose.rotations[lower] = glm::inverse(upperTurn) * lowerTurn;
    pose.rotations[ankle] = glm::inverse(lowerTurn) * foot.rotation;
    pose.rotations[onSide(ToesLeft, side)] = turnX(-foot.toeBend);
    return wanted - reach;
}

void poseArm(Pose& pose, Side side, const dvec3& upper, const dvec3& lower)
{
    const Joint shoulder = onSide(UpperArmLeft, side), elbow = onSide(LowerArmLeft, side), wrist = onSide(HandLeft, side);
    const dvec3 bindHinge{-1, 0, 0};
    const dvec3 hinge = glm::cross(upper, lower);
    const dquat upperTurn = limbTurn(shoulder, elbow, bindHinge, upper, hinge);
    const dquat lowerTurn = limbTurn(elbow, wrist, bindHinge, lower, hinge);
    pose.rotations[shoulder] = upperTurn;
    pose.rotations[elbow] = glm::inverse(upperTurn) * lowerTurn;
}

} // namespace antumbra::character
