#include "tools/make_character/skeleton.h"

namespace antumbra::character {

// An A-pose: arms 40 degrees from the body, so that neither hanging nor raised arms fold the shoulder far.
const std::array<JointPlace, kJointCount>& skeleton()
{
    static const std::array<JointPlace, kJointCount> places{{
        {"hips", Hips, {0, 0.945, 0}},
        {"spine", Hips, {0, 1.06, -0.005}},
        {"chest", Spine, {0, 1.22, -0.015}},
        {"neck", Chest, {0, 1.475, -0.02}},
        {"head", Neck, {0, 1.555, 0}},
        {"upper_arm_left", Chest, {0.172, 1.405, -0.015}},
        {"lower_arm_left", UpperArmLeft, {0.352, 1.19, -0.02}},
        {"hand_left", LowerArmLeft, {0.502, 0.995, 0.01}},
        {"upper_leg_left", Hips, {0.09, 0.915, 0}},
        {"lower_leg_left", UpperLegLeft, {0.097, 0.495, 0.008}},
        {"foot_left", LowerLegLeft, {0.1, 0.085, -0.025}},
        {"toes_left", FootLeft, {0.106, 0.028, 0.105}},
        {"upper_arm_right", Chest, {-0.172, 1.405, -0.015}},
        {"lower_arm_right", UpperArmRight, {-0.352, 1.19, -0.02}},
        {"hand_right", LowerArmRight, {-0.502, 0.995, 0.01}},
        {"upper_leg_right", Hips, {-0.09, 0.915, 0}},
        {"lower_leg_right", UpperLegRight, {-0.097, 0.495, 0.008}},
        {"foot_right", LowerLegRight, {-0.1, 0.085, -0.025}},
        {"toes_right", FootRight, {-0.106, 0.028, 0.105}},
    }};
    return places;
}

dvec3 bindOffset(Joint from, Joint to) { return skeleton()[to].bind - skeleton()[from].bind; }

} // namespace antumbra::character
