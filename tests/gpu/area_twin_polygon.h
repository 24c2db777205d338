// Convex spherical polygons of the twin: split by planes through the point, integrated against the clamped cosine, and what lists of convex
// cones leave of them (methods/area-shadows.md, The method, Guards 1 and 2). For float and double.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace antumbra::twin {

template <class Real>
using Vec = glm::vec<3, Real>;
template <class Real>
using Planes = std::vector<Vec<Real>>; // through the point; what counts is in front

/// What rounding leaves of zero. In double these are as small as its own; the input's rounding to float is then part of the input.
template <class Real>
struct Tolerance
{
    static constexpr Real kUnit = std::numeric_limits<Real>::epsilon();
    static constexpr Real kOnPlane = 2 * kUnit; // of unit vectors
    static constexpr Real kLevel = 4 * kUnit;   // of the reach of the body whose plane it is
    static constexpr Real kSeen = kUnit;        // of the distance
};

template <class Real>
Vec<Real> unitOrNone(const Vec<Real>& v)
{
    const Real length = glm::length(v);
    return length > 0 ? v / length : Vec<Real>(0);
}

template <class Real>
struct Corner
{
    Vec<Real> direction;
    Real planeZ; // of the inward normal of the arc to the next corner
};
template <class Real>
using Polygon = std::vector<Corner<Real>>;

/// theta / sin theta - 1 by the square of the chord: every term is the one before times s (2k + 2) / (2k + 3).
template <class Real>
Real curvature(Real chord2)
{
    const Real s = chord2 / 4;
    Real term = 1, sum = 0;
    for (int k = 0; k < 60 && term > std::numeric_limits<Real>::epsilon() * sum; ++k) {
        term *= s * (2 * k + 2) / (2 * k + 3);
        sum += term;
    }
    return sum;
}

template <class Real>
Real formFactor(const Polygon<Real>& polygon)
{
    Real sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec<Real> a = polygon[i].direction, b = polygon[(i + 1) % polygon.size()].direction, chord = b - a;
        const Vec<Real> p = a - polygon[0].direction, q = b - polygon[0].direction;
        const Real chord2 = glm::dot(chord, chord), crossZ = a.x * chord.y - a.y * chord.x;
        const Real angle = 2 * std::atan2(glm::length(a - b), glm::length(a + b));
        sum += p.x * q.y - p.y * q.x;
        if (chord2 < Real(0.3))
            sum += curvature(chord2) * crossZ;
        else if (chord2 < Real(3.8))
            sum += (angle / std::max(glm::length(glm::cross(a, chord)), Real(1e-6)) - 1) * crossZ; // zero for a crossing of opposite ends
        else
            sum += angle * polygon[i].planeZ - crossZ;
    }
    return sum / (2 * std::numbers::pi_v<Real>);
}

/// On which sides of a plane a polygon has corners.
template <class Real>
struct Sides
{
    std::vector<Real> heights;
    bool hasFront = false, hasBehind = false;

    Sides(const Polygon<Real>& polygon, const Vec<Real>& plane)
    {
        for (const Corner<Real>& corner : polygon) {
            const Real height = glm::dot(plane, corner.direction);
            heights.push_back(std::abs(height) <= Tolerance<Real>::kOnPlane ? 0 : height);
            hasFront = hasFront || heights.back() > 0;
            hasBehind = hasBehind || heights.back() < 0;
        }
    }

    /// Guard 1: the weaker side is none where there are more than two changes.
    void heal()
    {
        std::vector<Real> nonzero;
        std::ranges::copy_if(heights, std::back_inserter(nonzero), [](Real height) { return height != 0; });
        size_t changes = 0;
        for (size_t i = 0; i < nonzero.size(); ++i)
            changes += (nonzero[i] > 0) != (nonzero[(i + 1) % nonzero.size()] > 0) ? 1 : 0;
        if (changes <= 2)
            return;
        const bool keepsFront = *std::ranges::max_element(nonzero) >= -*std::ranges::min_element(nonzero);
        for (Real& height : heights)
            height = (height > 0) == keepsFront ? height : 0;
    }
};

/// The part in front of the plane.
template <class Real>
Polygon<Real> partInFront(const Polygon<Real>& polygon, const std::vector<Real>& heights, const Vec<Real>& plane)
{
    Polygon<Real> part;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const size_t next = (i + 1) % polygon.size();
        const Real here = heights[i], there = heights[next];
        if (here >= 0)
            part.push_back({polygon[i].direction, here > 0 || there >= 0 ? polygon[i].planeZ : plane.z});
        if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
            const Vec<Real> front = polygon[here > 0 ? i : next].direction, behind = polygon[here > 0 ? next : i].direction;
            const Real high = std::max(here, there), low = std::min(here, there);
            part.push_back({unitOrNone(front * -low + behind * high), here > 0 ? plane.z : polygon[i].planeZ});
        }
    }
    return part.size() >= 3 ? part : Polygon<Real>{};
}

template <class Real>
struct Halves
{
    Polygon<Real> front, behind;
};

template <class Real>
Halves<Real> split(const Polygon<Real>& polygon, const Vec<Real>& plane)
{
    Sides<Real> sides(polygon, plane);
    if (!sides.hasBehind)
        return {sides.hasFront ? polygon : Polygon<Real>{}, {}};
    if (!sides.hasFront)
        return {{}, polygon};
    sides.heal();
    Halves<Real> halves{partInFront(polygon, sides.heights, plane), {}};
    for (Real& height : sides.heights)
        height = -height;
    halves.behind = partInFront(polygon, sides.heights, -plane);
    return halves;
}

template <class Real>
Polygon<Real> clipped(Polygon<Real> polygon, const Planes<Real>& planes)
{
    for (const Vec<Real>& plane : planes) {
        if (polygon.empty())
            break;
        polygon = split(polygon, plane).front;
    }
    return polygon;
}

template <class Real>
bool mayMeet(const Polygon<Real>& polygon, const Planes<Real>& occluder)
{
    return !occluder.empty() && std::ranges::all_of(occluder, [&](const Vec<Real>& plane) { return Sides<Real>(polygon, plane).hasFront; });
}

template <class Real>
bool covers(const Planes<Real>& occluder, const Polygon<Real>& polygon)
{
    return std::ranges::none_of(occluder, [&](const Vec<Real>& plane) { return Sides<Real>(polygon, plane).hasBehind; });
}

/// `visible` of the method's page.
template <class Real>
Real visibleOf(const Polygon<Real>& polygon, const std::vector<const Planes<Real>*>& occluders)
{
    std::vector<const Planes<Real>*> live;
    for (const Planes<Real>* occluder : occluders) {
        if (!mayMeet(polygon, *occluder))
            continue;
        if (covers(*occluder, polygon))
            return 0;
        live.push_back(occluder);
    }
    for (size_t i = 0; i < live.size(); ++i) {
        const Polygon<Real> hidden = clipped(polygon, *live[i]);
        if (hidden.empty())
            continue;
        const std::vector<const Planes<Real>*> rest(live.begin() + static_cast<std::ptrdiff_t>(i) + 1, live.end());
        if (rest.size() < 2)
            return visibleOf(polygon, rest) - visibleOf(hidden, rest);
        Real sum = 0;
        Polygon<Real> inside = polygon;
        for (const Vec<Real>& plane : *live[i]) {
            Halves<Real> halves = split(inside, plane);
            if (!halves.behind.empty())
                sum += visibleOf(halves.behind, rest);
            inside = std::move(halves.front);
            if (inside.empty())
                break;
        }
        return sum;
    }
    return formFactor(polygon);
}

} // namespace antumbra::twin
