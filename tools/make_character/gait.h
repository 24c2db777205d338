// Stepping: walking, running and turning on the spot as one motion of different measures, without sliding feet.
#pragma once

#include "tools/make_character/pose.h"

#include <vector>

namespace antumbra::character {

struct PitchKey
{
    double phase;   // of the foot's own cycle, which begins as it lands
    double degrees; // toes up
};

/// Angles in degrees, lengths in metres, times in seconds.
struct Gait
{
    double duration;        // of a cycle, two steps
    double speed;           // ahead
    double turnRate;        // radians a second, to the left
    double stance;          // share of the cycle that a foot is on the ground
    double heelAtMidStance; // ahead of the hips
    double lift;
    std::vector<PitchKey> footPitch;

    double hipsDrop, hipsBob, hipsLowestPhase;
    double lean, pelvisYaw, pelvisSway;
    double armSwing, armBack, elbowBend, elbowSwing;
};

Gait walkGait();
Gait runGait();
Gait turnGait();

Pose poseOf(const Gait& gait, double phase);

} // namespace antumbra::character
