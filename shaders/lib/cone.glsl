// Cones that hold all rays from a point to a sphere or a capsule (Xu et al. 2022, eq. 4 and 5, as corrected in methods/conical-culling.md).
#ifndef LIB_CONE_GLSL
#define LIB_CONE_GLSL

const float kHalfPi = 1.57079632679;

struct Cone
{
    vec3 axis; // unit
    float cosine; // of the half angle, rounded down: dot(ray, axis) >= cosine holds for every ray of the cone; -1 where `all`
    float chord; // from the axis to the rim on the unit sphere, rounded up: tells rays apart where cosines are all 1
    float halfAngle; // radians, pi/2 where `all`
    float height; // rays may end here
    bool all; // the apex lies inside: the whole hemisphere about n
};

// Radians for x in 0..1, to a few units in the last place; drivers may be off by 1e-4 and more. A fit of asin up to 1/2 (relative error
// 2e-8) and the half-angle identity above it.
float arcSine(float x)
{
    bool isWide = x > 0.5;
    float s = isWide ? sqrt(0.5 - 0.5 * x) : x;
    float t = s * s;
    float angle = s + s * t * (0.166666724 + t * (0.0749885507 + t * (0.0450013801 + t * (0.0265545422 + t * 0.0380850236))));
    return isWide ? kHalfPi - 2.0 * angle : angle;
}

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

// Both spheres of a capsule lie in a convex cone, so their hull does. Half angles past a right angle hold everything.
Cone coneOfCapsule(vec3 p, vec3 n, vec3 a, vec3 b, float radius)
{
    vec3 ab = b - a;
    vec3 toA = a - p, toB = b - p;
    float lengthA = length(toA), lengthB = length(toB);
    float height = max(lengthA, lengthB) + radius;
    float t = clamp(-dot(toA, ab) / max(dot(ab, ab), 1.0e-30), 0.0, 1.0);
    if (min(length(toA + t * ab), min(lengthA, lengthB)) <= radius * (1.0 + 1.0e-6))
        return wholeHemisphere(n, height);
    vec3 axisA = toA / lengthA, axisB = toB / lengthB;
    float sineA = min(radius / lengthA, 1.0), sineB = min(radius / lengthB, 1.0);
    float angleA = arcSine(sineA), angleB = arcSine(sineB);
    // Between the axes by the half chord: exact for small angles, where acos is not.
    float between = 2.0 * arcSine(min(0.5 * length(axisA - axisB), 1.0));
    if (between + angleB <= angleA)
        return coneAbout(axisA, sineA, angleA, height);
    if (between + angleA <= angleB)
        return coneAbout(axisB, sineB, angleB, height);
    float halfAngle = 0.5 * (between + angleA + angleB) + 1.0e-5;
    if (halfAngle >= 1.5707)
        return wholeHemisphere(n, height);
    // Along the great circle from A to B, by the tangent at A.
    vec3 tangent = axisB - axisA * dot(axisA, axisB);
    float tangentLength = length(tangent);
    float turn = halfAngle - angleA;
    vec3 axis = tangentLength > 1.0e-7 ? normalize(axisA * cos(turn) + tangent * (sin(turn) / tangentLength)) : axisA;
    return coneAbout(axis, sin(halfAngle), halfAngle, height);
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
    float near2 = dot(nearest, nearest);
    // All products err by some units in the last place of their factors' lengths; so much is given on either side.
    float least = sqrt(max(dot(middle, middle) - reach * reach, 0.0)) * (1.0 - 1.0e-5) - 2.0e-6 * reach;
    vec3 across = cross(middle, arm);
    float most = radius * sqrt((1.0 + 1.0e-5) * dot(across, across) / max(near2, 1.0e-30)) + 1.0e-6 * reach * reach;
    bool isInside = near2 <= radius * radius;
    return CapsuleBound(middle, isInside || dot(middle, middle) <= reach * reach ? -1.0e30 : least, across, isInside ? 1.0e30 : most);
}

bool mayMeet(CapsuleBound bound, vec3 direction)
{
    return dot(direction, bound.towards) >= bound.least && abs(dot(direction, bound.across)) <= bound.most;
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
