#include "tools/make_character/clips.h"

#include "tools/make_character/gait.h"

#include <cmath>
#include <numbers>

namespace antumbra::character {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// 0 outside [rise, fall], 1 inside, easing over `ease` at both ends.
double plateau(double phase, double rise, double fall, double ease)
{
    return glm::smoothstep(rise, rise + ease, phase) * (1 - glm::smoothstep(fall - ease, fall, phase));
}

void poseHangingArm(Pose& pose, Side side, double lift)
{
    const double spread = signOf(side) * (glm::radians(10.0) + lift);
    const dvec3 upper = turnX(0.06) * turnZ(spread) * dvec3{0, -1, 0};
    const dvec3 lower = turnX(-0.26) * turnZ(0.5 * spread) * dvec3{0, -1, 0};
    poseArm(pose, side, upper, lower);
    pose.rotations[onSide(HandLeft, side)] = turnX(-0.1);
}

/// Two breaths and one shift of weight a loop.
Pose standing(double phase)
{
    const double breath = std::sin(2 * kTurn * phase), sway = std::sin(kTurn * phase);
    Pose pose;
    pose.hips += dvec3{0.012 * sway, -0.0045 + 0.001 * breath, -0.008};
    pose.rotations[Hips] = turnZ(0.01 * sway);
    pose.rotations[Spine] = turnX(-0.006 * breath) * turnZ(-0.012 * sway);
    pose.rotations[Chest] = turnX(-0.018 * breath);
    pose.rotations[Neck] = turnX(0.03 + 0.012 * breath);
    pose.rotations[Head] = turnY(0.07 * std::sin(kTurn * phase + 0.8)) * turnX(0.006 * breath - 0.02);
    for (const Side side : {Side::Left, Side::Right}) {
        const dvec3 ankle = skeleton()[onSide(FootLeft, side)].bind + dvec3{0.01 * signOf(side), 0, 0};
        const dquat toedOut = turnY(signOf(side) * glm::radians(9.0));
        poseLeg(pose, side, {.ankle = ankle, .rotation = toedOut});
        poseHangingArm(pose, side, 0.012 * breath);
    }
    return pose;
}

Pose waving(double phase)
{
    constexpr double kSwings = 4;
    Pose pose = standing(phase);
    const double raised = plateau(phase, 0.02, 0.98, 0.2);
    const double swing = 0.32 * plateau(phase, 0.14, 0.86, 0.14) * std::sin(kSwings * kTurn * phase);
    Pose up = pose;
    const dvec3 upper = glm::normalize(dvec3{-0.86, -0.1, 0.38});
    const dvec3 lower = turnZ(0.12 + swing) * glm::normalize(dvec3{-0.12, 0.97, 0.2});
    poseArm(up, Side::Right, upper, lower);
    up.rotations[HandRight] = turnX(0.5 * swing);
    for (const Joint joint : {UpperArmRight, LowerArmRight, HandRight})
        pose.rotations[joint] = glm::slerp(pose.rotations[joint], up.rotations[joint], raised);
    pose.rotations[Chest] = pose.rotations[Chest] * turnZ(-0.05 * raised);
    pose.rotations[Head] = pose.rotations[Head] * turnZ(0.06 * raised) * turnX(-0.05 * raised);
    return pose;
}

// Rounded so that a last bit of another machine's mathematics does not reach the file.
float rounded(double value)
{
    constexpr double kSteps = 1 << 15;
    return static_cast<float>(std::round(value * kSteps) / kSteps);
}

} // namespace

std::vector<Motion> motions()
{
    const auto stepping = [](std::string name, const Gait& gait) {
        return Motion{std::move(name), gait.duration, 30 / gait.duration, [gait](double phase) { return poseOf(gait, phase); }};
    };
    return {{"idle", 6, 6, standing},
            stepping("walk", walkGait()),
            stepping("run", runGait()),
            {"wave", 3, 20, waving},
            stepping("turn", turnGait())};
}

scene::Clip toClip(const Motion& motion)
{
    using scene::Channel;
    const int steps = static_cast<int>(std::lround(motion.duration * motion.keysPerSecond));
    scene::Clip clip{.name = motion.name, .duration = rounded(motion.duration), .tracks = {}};
    clip.tracks.push_back({.channel = Channel::Translation, .target = Hips, .width = 3, .times = {}, .values = {}});
    for (uint32_t joint = 0; joint < kJointCount; ++joint)
        clip.tracks.push_back({.channel = Channel::Rotation, .target = joint, .width = 4, .times = {}, .values = {}});

    std::array<dquat, kJointCount> before = motion.at(0).rotations;
    for (int step = 0; step <= steps; ++step) {
        Pose pose = motion.at(static_cast<double>(step % steps) / steps);
        for (scene::Track& track : clip.tracks)
            track.times.push_back(rounded(motion.duration * step / steps));
        for (int i = 0; i < 3; ++i)
            clip.tracks[0].values.push_back(rounded(pose.hips[i]));
        for (size_t joint = 0; joint < kJointCount; ++joint) {
            dquat& rotation = pose.rotations[joint];
            if (glm::dot(rotation, before[joint]) < 0) // the sign that interpolates the short way
                rotation = -rotation;
            for (const double part : {rotation.x, rotation.y, rotation.z, rotation.w})
                clip.tracks[joint + 1].values.push_back(rounded(part));
        }
        before = pose.rotations;
    }
    return clip;
}

} // namespace antumbra::character
