// Tapered limbs joined by the polynomial smooth minimum. Only the left half is described; the field mirrors it.
#include "tools/make_character/body.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace antumbra::character {

namespace {

/// A segment swept by a sphere of changing radius, flattened across `thin` to the share `flat` of its thickness.
struct Limb
{
    Joint joint;
    dvec3 from, to;
    double radiusFrom, radiusTo;
    dvec3 thin{0, 0, 1};
    double flat = 1;
    double blend = 0.03; // metres over which it flows into what stands before it
};

constexpr dvec3 kAcross{1, 0, 0};
constexpr dvec3 kUp{0, 1, 0};
constexpr dvec3 kAhead{0, 0, 1};
constexpr dvec3 kPalm{0.79, 0.61, 0}; // normal to the hand, which hangs with the thumb ahead

std::span<const Limb> limbs()
{
    static const std::array kLimbs{
        Limb{Hips, {0, 0.935, -0.005}, {0.072, 0.925, -0.005}, 0.112, 0.104, kAhead, 0.94},
        Limb{Hips, {0.068, 0.90, -0.04}, {0.068, 0.88, -0.04}, 0.084, 0.076, kAhead, 1, 0.04},
        Limb{Spine, {0, 1.06, -0.002}, {0.045, 1.06, -0.002}, 0.104, 0.098, kAhead, 0.88, 0.08},
        Limb{Spine, {0, 1.0, 0}, {0, 1.16, -0.005}, 0.125, 0.128, kAhead, 0.78, 0.04},
        Limb{Chest, {0, 1.27, -0.008}, {0.062, 1.275, -0.012}, 0.118, 0.108, kAhead, 0.96, 0.08},
        Limb{Chest, {0, 1.375, -0.022}, {0.118, 1.385, -0.02}, 0.088, 0.066, kAhead, 0.96, 0.06},
        Limb{Chest, {0.03, 1.43, -0.025}, {0.135, 1.415, -0.02}, 0.052, 0.048, kAhead, 1, 0.05},
        Limb{Neck, {0, 1.44, -0.026}, {0, 1.56, 0.002}, 0.062, 0.053, kAhead, 1, 0.045},
        Limb{Head, {0, 1.655, -0.012}, {0, 1.657, 0.008}, 0.0945, 0.092, kAcross, 0.83, 0.03},
        Limb{Head, {0, 1.63, 0.02}, {0, 1.568, 0.042}, 0.076, 0.05, kAcross, 0.84, 0.03},
        Limb{Head, {0, 1.668, 0.088}, {0, 1.632, 0.094}, 0.007, 0.0105, kAcross, 1, 0.03},

        Limb{UpperArmLeft, {0.168, 1.402, -0.017}, {0.2, 1.372, -0.018}, 0.062, 0.058, kAhead, 0.97, 0.05},
        Limb{UpperArmLeft, {0.18, 1.395, -0.017}, {0.352, 1.19, -0.02}, 0.054, 0.0425, kAhead, 1, 0.03},
        Limb{LowerArmLeft, {0.352, 1.19, -0.02}, {0.40, 1.128, -0.01}, 0.0425, 0.045, kAhead, 1, 0.02},
        Limb{LowerArmLeft, {0.40, 1.128, -0.01}, {0.502, 0.995, 0.01}, 0.044, 0.029, kPalm, 0.92, 0.02},
        Limb{HandLeft, {0.512, 0.982, 0.012}, {0.554, 0.928, 0.02}, 0.033, 0.042, kPalm, 0.46, 0.02},
        Limb{HandLeft, {0.554, 0.928, 0.02}, {0.602, 0.858, 0.026}, 0.040, 0.031, kPalm, 0.46, 0.015},
        Limb{HandLeft, {0.524, 0.968, 0.034}, {0.553, 0.915, 0.074}, 0.018, 0.0125, kPalm, 0.95, 0.016},

        Limb{UpperLegLeft, {0.086, 0.90, -0.002}, {0.097, 0.50, 0.008}, 0.092, 0.062, kAhead, 1, 0.035},
        Limb{LowerLegLeft, {0.097, 0.50, 0.008}, {0.1, 0.13, -0.02}, 0.060, 0.046, kAhead, 1, 0.02},
        Limb{LowerLegLeft, {0.1, 0.41, -0.014}, {0.1, 0.29, -0.02}, 0.057, 0.05, kAhead, 1, 0.03},
        Limb{FootLeft, {0.1, 0.10, -0.025}, {0.1, 0.05, -0.035}, 0.042, 0.043, kAhead, 1, 0.02},
        Limb{FootLeft, {0.1, 0.06, -0.02}, {0.106, 0.032, 0.10}, 0.045, 0.044, kUp, 0.85, 0.03},
        Limb{ToesLeft, {0.106, 0.03, 0.10}, {0.108, 0.024, 0.16}, 0.045, 0.034, kUp, 0.78, 0.02},
    };
    return kLimbs;
}

double smoothMinimum(double a, double b, double width)
{
    const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - 0.25 * width * overlap * overlap;
}

// The distance in the space where the limb is round, divided by that space's stretch along the gradient.
double distanceTo(const Limb& limb, const dvec3& point)
{
    const double stretch = 1 / limb.flat - 1;
    const dvec3 axis = limb.to - limb.from;
    const dvec3 round = point + stretch * glm::dot(point - limb.from, limb.thin) * limb.thin;
    const double along = std::clamp(glm::dot(round - limb.from, axis) / glm::dot(axis, axis), 0.0, 1.0);
    const dvec3 out = round - limb.from - along * axis;
    const double reach = std::max(glm::length(out), 1e-9);
    const dvec3 gradient = (out + stretch * glm::dot(out, limb.thin) * limb.thin) / reach;
    return (reach - glm::mix(limb.radiusFrom, limb.radiusTo, along)) / glm::length(gradient);
}

dvec3 onLeft(const dvec3& point) { return {std::abs(point.x), point.y, point.z}; }

} // namespace

double distanceToBody(const dvec3& point)
{
    constexpr double kSoleRounding = 0.015;
    const dvec3 left = onLeft(point);
    double distance = 1;
    for (const Limb& limb : limbs())
        distance = smoothMinimum(distance, distanceTo(limb, left), limb.blend);
    return -smoothMinimum(-distance, left.y, kSoleRounding); // the ground cuts the soles flat
}

dvec3 normalOfBody(const dvec3& point)
{
    constexpr double kStep = 1e-4;
    dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 step{0};
        step[axis] = kStep;
        gradient[axis] = distanceToBody(point + step) - distanceToBody(point - step);
    }
    return glm::normalize(gradient);
}

dvec3 snapped(const dvec3& point)
{
    constexpr double kStepsPerMetre = 1 << 24;
    return glm::round(point * kStepsPerMetre) / kStepsPerMetre;
}

dvec3 ontoBody(dvec3 point)
{
    for (int i = 0; i < 4; ++i)
        point -= distanceToBody(point) * normalOfBody(point);
    return snapped(point);
}

Joint limbAt(const dvec3& point)
{
    const dvec3 left = onLeft(point);
    const auto nearest = std::ranges::min_element(limbs(), {}, [&](const Limb& limb) { return distanceTo(limb, left); });
    const bool isPaired = nearest->joint >= UpperArmLeft;
    return isPaired && point.x < 0 ? onSide(nearest->joint, Side::Right) : nearest->joint;
}

Cloth clothAt(const dvec3& point)
{
    constexpr double kSleeve = 0.165;
    const dvec3 left = onLeft(point);
    const dvec3 arm = glm::normalize(bindOffset(UpperArmLeft, LowerArmLeft));
    const bool isArm = left.x > 0.2 && left.y < 1.45;
    if (isArm)
        return glm::dot(left - skeleton()[UpperArmLeft].bind, arm) > kSleeve ? Skin : Shirt;
    if (left.y < 0.105)
        return Leather;
    if (left.y < 1.0)
        return Trousers;
    const double fromNeckAxis = std::hypot(left.x, left.z - skeleton()[Neck].bind.z);
    const bool isUnderCollar = left.y - 0.9 * fromNeckAxis + 0.25 * left.z < 1.415;
    if (isUnderCollar)
        return Shirt;
    const bool isHair = left.y - 1.1 * left.z > 1.65 && left.y + 0.4 * left.z > 1.59;
    return isHair ? Leather : Skin;
}

double detailAt(const dvec3& point)
{
    constexpr double kFaceBegins = 0.055;
    switch (limbAt(point)) {
    case Head: return point.z > kFaceBegins ? 0.017 : 0.026;
    case HandLeft:
    case HandRight: return 0.0195;
    case FootLeft:
    case FootRight: return 0.026;
    case ToesLeft:
    case ToesRight: return 0.021;
    case Neck:
    case LowerArmLeft:
    case LowerArmRight: return 0.031;
    default: return 0.042;
    }
}

} // namespace antumbra::character
