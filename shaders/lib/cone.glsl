// What holds all rays from a point to a sphere or a capsule (Xu et al. 2022, eq. 4 and 5, as corrected in methods/conical-culling.md).
#ifndef LIB_CONE_GLSL
#define LIB_CONE_GLSL

#include "lib/angle.glsl"

struct Cone
{
    vec3 axis; // unit
    float cosine; // of the half angle, rounded down: dot(ray, axis) >= cosine holds for every ray of the cone; -1 where `all`
    float chord; // from the axis to the rim on the unit sphere, rounded up: tells rays apart where cosines are all 1
    float halfAngle; // radians, pi/2 where `all`
    float height; // rays may end here
    bool all; // the apex lies inside: the whole hemisphere about n
};

// The half angle's sine and cosine are as good as their rounding where it is near nothing and near a right angle; a millionth off the
// squared cosine is more than that rounding, so that no ray is dropped.
Cone coneAbout(vec3 axis, float sine, float halfAngle, float height)
{
    float cosine = sqrt(max(0.0, (1.0 - sine) * (1.0 + sine) - 1.0e-6));
    return Cone(axis, cosine, sine * sqrt(2.0 / (1.0 + cosine)), halfAngle, height, false);
}

Cone wholeHemisphere(vec3 n, float height) { return Cone(n, -1.0, 2.0, kHalfPi, height, true); }

// The sphere lies wholly behind the plane through p with normal n.
bool isBehind(vec3 p, vec3 n, vec3 centre, float radius) { return dot(centre - p, n) <= -radius; }

Cone coneOfSphere(vec3 p, vec3 n, vec3 centre, float radius)
{
    vec3 to = centre - p;
    float distance = length(to);
    if (distance <= radius * (1.0 + 1.0e-6))
        return wholeHemisphere(n, distance + radius);
    float sine = min(radius / distance, 1.0);
    return coneAbout(to / distance, sine, arcSine(sine), distance + radius);
}

// What every ray from the apex that meets a capsule obeys: it lies in the cone of the sphere about the capsule, and it leaves the plane
// through apex and axis by no more than the radius seen from the nearest point of the axis. Two dot products a ray.
struct CapsuleBound
{
    vec3 towards; // the capsule's middle
    float least; // of dot(ray, towards)
    vec3 across; // normal of the plane, of any length
    float most; // of |dot(ray, across)|
};

// The capsule's middle relative to the apex, and the arm from it to one end; `reach` is the radius of the sphere about the middle.
CapsuleBound boundOfCapsule(vec3 middle, vec3 arm, float radius, float reach)
{
    float t = clamp(-dot(middle, arm) / max(dot(arm, arm), 1.0e-30), -1.0, 1.0);
    vec3 nearest = middle + t * arm;
    float near2 = max(dot(nearest, nearest), 1.0e-30);
    float beyond2 = dot(middle, middle) - reach * reach;
    float beyond = sqrt(max(beyond2, 0.0));
    vec3 across = cross(middle, arm);
    // The products are off by some units in the last place of their factors' lengths; |middle| is at most beyond + reach.
    float least = beyond - 1.0e-5 * (beyond + reach);
    float most = radius * sqrt(dot(across, across) / near2) + 2.0e-6 * (beyond + reach) * reach;
    bool isInside = near2 <= radius * radius;
    return CapsuleBound(middle, isInside || beyond2 <= 0.0 ? -1.0e30 : least, across, isInside ? 1.0e30 : most);
}

// Asked so that what overflows is held.
bool mayMeet(CapsuleBound bound, vec3 direction)
{
    return !(dot(direction, bound.towards) < bound.least || abs(dot(direction, bound.across)) > bound.most);
}

// A ray that only rounding puts outside is held.
bool holds(Cone cone, vec3 direction) { return cone.all || distance(direction, cone.axis) <= cone.chord + 1.0e-6; }

// The greatest share of constant light's irradiance that a cone about `axis` can hide: its solid angle times the greatest cosine in it.
float greatestShare(Cone cone, vec3 n)
{
    if (cone.all)
        return 1.0;
    // sin(elevation + half angle), which is 1 from a right angle on.
    float sine = clamp(dot(cone.axis, n), -1.0, 1.0);
    float sineHalf = sqrt(max(1.0 - cone.cosine * cone.cosine, 0.0));
    float cosine = sine >= cone.cosine ? 1.0 : max(sine * cone.cosine + sqrt(1.0 - sine * sine) * sineHalf, 0.0);
    return cone.chord * cone.chord * cosine; // solid angle / pi
}

#endif
