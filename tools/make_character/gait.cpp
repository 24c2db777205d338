#include "tools/make_character/gait.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antumbra::character {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Where the foot touches the ground, seen from the ankle in the bind pose.
constexpr dvec3 kHeel{0, -0.085, -0.045};
constexpr dvec3 kBall{0, -0.057, 0.13}; // the toes' joint: the foot rolls about it
constexpr dvec3 kSole{0, -0.085, 0.13}; // beneath the ball
constexpr double kToeLength = 0.085;

double wrapped(double phase) { return phase - std::floor(phase); }
double eased(double t) { return t * t * (3 - 2 * t); }

/// Periodic, level at every key.
double pitchAt(const std::vector<PitchKey>& keys, double phase)
{
    for (size_t i = 0; i < keys.size(); ++i) {
        const PitchKey& from = keys[i];
        const PitchKey to = i + 1 < keys.size() ? keys[i + 1] : PitchKey{1, keys[0].degrees};
        if (phase <= to.phase)
            return glm::radians(glm::mix(from.degrees, to.degrees, eased((phase - from.phase) / (to.phase - from.phase))));
    }
    return glm::radians(keys[0].degrees);
}

/// How far the toes must bend up to lie flat while the heel is raised.
double toeBendAt(double pitch) { return std::min(std::max(-pitch, 0.0), glm::radians(50.0)); }

/// A foot on the ground: the ground runs back beneath the body, the foot rolls over heel and ball.
FootTarget planted(const Gait& gait, Side side, double phase)
{
    const double sinceMiddle = (phase - 0.5 * gait.stance) * gait.duration;
    const double pitch = pitchAt(gait.footPitch, phase);
    const dquat heading = turnY(-gait.turnRate * sinceMiddle);
    const double sideways = signOf(side) * (gait.speed > 0 ? 0.075 : 0.105);
    const dvec3 heel = heading * dvec3{sideways, 0, gait.heelAtMidStance} - dvec3{0, 0, gait.speed * sinceMiddle};

    FootTarget foot{.rotation = heading * turnX(-pitch), .toeBend = toeBendAt(pitch)};
    if (pitch >= 0)
        foot.ankle = heel - foot.rotation * kHeel;
    else
        foot.ankle = heel + heading * (kBall - kHeel) - foot.rotation * kBall;
    return foot;
}

double lowestPoint(const FootTarget& foot)
{
    const dvec3 toeTip = kBall + turnX(-foot.toeBend) * (kSole - kBall + dvec3{0, 0, kToeLength});
    return std::min({(foot.rotation * kHeel).y, (foot.rotation * kSole).y, (foot.rotation * toeTip).y});
}

/// A foot in the air, from where and as fast as it left the ground to where it lands.
FootTarget swinging(const Gait& gait, Side side, double phase)
{
    constexpr double kInstant = 1e-4;
    const double share = (phase - gait.stance) / (1 - gait.stance);
    const FootTarget leaving = planted(gait, side, gait.stance), landing = planted(gait, side, 0);
    const double length = (1 - gait.stance) / kInstant;
    const dvec3 leavingSpeed = length * (leaving.ankle - planted(gait, side, gait.stance - kInstant).ankle);
    const dvec3 landingSpeed = length * (planted(gait, side, kInstant).ankle - landing.ankle);

    const double s = share, s2 = s * s, s3 = s2 * s;
    const double bump = 16 * s2 * (1 - s) * (1 - s);
    const double pitch = pitchAt(gait.footPitch, phase);
    FootTarget foot{.rotation = glm::slerp(turnY(-0.5 * gait.turnRate * gait.stance * gait.duration),
                                           turnY(0.5 * gait.turnRate * gait.stance * gait.duration), eased(s)) *
                                turnX(-pitch),
                    .toeBend = leaving.toeBend * (1 - eased(std::min(2 * s, 1.0)))};
    foot.ankle = (2 * s3 - 3 * s2 + 1) * leaving.ankle + (s3 - 2 * s2 + s) * leavingSpeed + (3 * s2 - 2 * s3) * landing.ankle +
                 (s3 - s2) * landingSpeed;
    foot.ankle.y = std::max(foot.ankle.y + gait.lift * bump, 0.25 * gait.lift * bump - lowestPoint(foot));
    return foot;
}

FootTarget footAt(const Gait& gait, Side side, double phase)
{
    return phase <= gait.stance ? planted(gait, side, phase) : swinging(gait, side, phase);
}

void poseSwingingArm(Pose& pose, const Gait& gait, Side side, double forward)
{
    const double swing = glm::radians(gait.armSwing * forward - gait.armBack);
    const double bend = glm::radians(gait.elbowBend + gait.elbowSwing * forward);
    const double spread = signOf(side) * glm::radians(9.0);
    const dvec3 upper = turnX(-swing) * turnZ(spread) * dvec3{0, -1, 0};
    const dvec3 lower = turnX(-swing - bend) * turnZ(0.3 * spread) * turnY(-signOf(side) * 0.25) * dvec3{0, -1, 0};
    poseArm(pose, side, upper, lower);
    pose.rotations[onSide(HandLeft, side)] = turnX(-0.12);
}

} // namespace

Gait walkGait()
{
    return {.duration = 1.06,
            .speed = 1.4,
            .turnRate = 0,
            .stance = 0.61,
            .heelAtMidStance = -0.125,
            .lift = 0.05,
            .footPitch = {{0, 20}, {0.1, 0}, {0.3, 0}, {0.6, -50}, {0.85, 12}, {0.95, 21}},
            .hipsDrop = 0.054,
            .hipsBob = 0.018,
            .hipsLowestPhase = 0.04,
            .lean = 3,
            .pelvisYaw = 6,
            .pelvisSway = 0.018,
            .armSwing = 24,
            .armBack = 4,
            .elbowBend = 22,
            .elbowSwing = 10};
}

Gait runGait()
{
    return {.duration = 0.68,
            .speed = 3.3,
            .turnRate = 0,
            .stance = 0.35,
            .heelAtMidStance = -0.155,
            .lift = 0.2,
            .footPitch = {{0, 6}, {0.05, 0}, {0.14, 0}, {0.35, -50}, {0.52, -80}, {0.8, -10}, {0.94, 7}},
            .hipsDrop = 0.078,
            .hipsBob = 0.028,
            .hipsLowestPhase = 0.17,
            .lean = 11,
            .pelvisYaw = 8,
            .pelvisSway = 0.008,
            .armSwing = 38,
            .armBack = 12,
            .elbowBend = 85,
            .elbowSwing = 16};
}

Gait turnGait()
{
    return {.duration = 1.1,
            .speed = 0,
            .turnRate = 1.2,
            .stance = 0.62,
            .heelAtMidStance = -0.045,
            .lift = 0.07,
            .footPitch = {{0, 0}, {0.4, 0}, {0.64, -28}, {0.85, 4}},
            .hipsDrop = 0.012,
            .hipsBob = 0.004,
            .hipsLowestPhase = 0.06,
            .lean = 2,
            .pelvisYaw = 3,
            .pelvisSway = 0.03,
            .armSwing = 9,
            .armBack = 1,
            .elbowBend = 18,
            .elbowSwing = 5};
}

Pose poseOf(const Gait& gait, double phase)
{
    const double cycle = kTurn * phase;
    const double leftForward = std::cos(cycle); // the left foot lands ahead at phase 0
    const double yaw = glm::radians(gait.pelvisYaw) * leftForward;
    const double lean = glm::radians(gait.lean);
    constexpr double kGreatestMiss = 0.003;
    const double overLeft = std::sin(cycle); // weight on the left foot

    Pose pose;
    pose.hips.x += gait.pelvisSway * overLeft;
    pose.hips.y -= gait.hipsDrop + gait.hipsBob * std::cos(2 * (cycle - kTurn * gait.hipsLowestPhase));
    pose.rotations[Hips] = turnY(-yaw) * turnX(0.4 * lean) * turnZ(0.6 * gait.pelvisSway * overLeft);
    pose.rotations[Spine] = turnY(0.8 * yaw) * turnX(0.3 * lean) * turnZ(-0.5 * gait.pelvisSway * overLeft);
    pose.rotations[Chest] = turnY(0.9 * yaw) * turnX(0.3 * lean);
    pose.rotations[Neck] = turnY(-0.3 * yaw) * turnX(-0.4 * lean);
    pose.rotations[Head] = turnY(-0.4 * yaw + 0.15 * gait.turnRate) * turnX(-0.5 * lean + 0.02 * std::cos(2 * cycle));
    for (const Side side : {Side::Left, Side::Right}) {
        const double ownPhase = wrapped(side == Side::Left ? phase : phase + 0.5);
        const double missing = poseLeg(pose, side, footAt(gait, side, ownPhase));
        check(missing < kGreatestMiss, "feet within the legs' reach");
        poseSwingingArm(pose, gait, side, -signOf(side) * leftForward);
    }
    return pose;
}

} // namespace antumbra::character
