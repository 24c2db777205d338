// The walker's joints: where they stand in the bind pose, and what hangs on what. Metres, Y up, facing +Z, so left is +X.
#pragma once

#include "base/math.h"

#include <array>
#include <cstdint>

namespace antumbra::character {

using glm::dmat3;
using glm::dquat;
using glm::dvec3;

/// Parents come before children; the right side repeats the left one.
enum Joint : uint32_t {
    Hips,
    Spine,
    Chest,
    Neck,
    Head,
    UpperArmLeft,
    LowerArmLeft,
    HandLeft,
    UpperLegLeft,
    LowerLegLeft,
    FootLeft,
    ToesLeft,
    UpperArmRight,
    LowerArmRight,
    HandRight,
    UpperLegRight,
    LowerLegRight,
    FootRight,
    ToesRight,
    kJointCount
};

enum class Side { Left, Right };

struct JointPlace
{
    const char* name;
    Joint parent; // its own for the root
    dvec3 bind;   // model space
};

const std::array<JointPlace, kJointCount>& skeleton();

/// The same joint on `side`, given the left one.
constexpr Joint onSide(Joint left, Side side) { return side == Side::Left ? left : Joint(left + UpperArmRight - UpperArmLeft); }
constexpr double signOf(Side side) { return side == Side::Left ? 1 : -1; }

/// From one joint to another in the bind pose.
dvec3 bindOffset(Joint from, Joint to);

} // namespace antumbra::character
