// Cones that hold all rays from a point to a sphere or a capsule (Xu et al. 2022, eq. 4 and 5, as corrected in methods/conical-culling.md).
#ifndef LIB_CONE_GLSL
#define LIB_CONE_GLSL

struct Cone
{
    vec3 axis; // unit
    float cosine; // of the half angle; -1 for a cone that holds every ray of the hemisphere
    float halfAngle; // radians, pi/2 where `all`
    float height; // rays may end here
    bool all; // the apex lies inside: the whole hemisphere about n
};

// The sphere lies wholly behind the plane through p with normal n.
bool isBehind(vec3 p, vec3 n, vec3 centre, float radius) { return dot(centre - p, n) <= -radius; }

Cone coneOfSphere(vec3 p, vec3 n, vec3 centre, float radius)
{
    vec3 to = centre - p;
    float distance2 = dot(to, to);
    float limit = radius * (1.0 + 1.0e-6);
    if (distance2 <= limit * limit)
        return Cone(n, -1.0, 1.5707963267948966, sqrt(distance2) + radius, true);
    float inverse = inversesqrt(distance2);
    float sine = min(radius * inverse, 1.0);
    return Cone(to * inverse, sqrt(max(0.0, 1.0 - sine * sine)), asin(sine), distance2 * inverse + radius, false);
}

// Both spheres of a capsule lie in a convex cone, so their hull does. Half angles past a right angle hold everything.
Cone coneOfCapsule(vec3 p, vec3 n, vec3 a, vec3 b, float radius)
{
    vec3 ab = b - a;
    float t = clamp(dot(p - a, ab) / max(dot(ab, ab), 1.0e-20), 0.0, 1.0);
    vec3 nearest = a + t * ab - p;
    vec3 toA = a - p, toB = b - p;
    float lengthA = length(toA), lengthB = length(toB);
    float height = max(lengthA, lengthB) + radius;
    float limit = radius * (1.0 + 1.0e-6);
    if (dot(nearest, nearest) <= limit * limit)
        return Cone(n, -1.0, 1.5707963267948966, height, true);
    vec3 axisA = toA / lengthA, axisB = toB / lengthB;
    float angleA = asin(min(radius / lengthA, 1.0)), angleB = asin(min(radius / lengthB, 1.0));
    // Between the axes by the half chord: exact for small angles, where acos is not.
    float between = 2.0 * asin(min(0.5 * length(axisA - axisB), 1.0));
    if (between + angleB <= angleA)
        return Cone(axisA, cos(angleA), angleA, height, false);
    if (between + angleA <= angleB)
        return Cone(axisB, cos(angleB), angleB, height, false);
    float halfAngle = 0.5 * (between + angleA + angleB) + 1.0e-5;
    if (halfAngle >= 1.5707)
        return Cone(n, -1.0, 1.5707963267948966, height, true);
    // Along the great circle from A to B, by the tangent at A.
    vec3 tangent = axisB - axisA * dot(axisA, axisB);
    float tangentLength = length(tangent);
    float turn = halfAngle - angleA;
    vec3 axis = tangentLength > 1.0e-7 ? normalize(axisA * cos(turn) + tangent * (sin(turn) / tangentLength)) : axisA;
    return Cone(axis, cos(halfAngle), halfAngle, height, false);
}

bool holds(Cone cone, vec3 direction) { return cone.all || dot(direction, cone.axis) >= cone.cosine; }

// Cone `inner` lies in `outer`: angle(d1, d2) + psi1 <= psi2.
bool liesIn(Cone inner, Cone outer)
{
    if (outer.all)
        return true;
    return !inner.all && inner.halfAngle <= outer.halfAngle && dot(inner.axis, outer.axis) >= cos(outer.halfAngle - inner.halfAngle);
}

// Before which of two cones merging looks: all first, then the wider.
bool goesFirst(Cone a, Cone b) { return a.all != b.all ? a.all : a.halfAngle > b.halfAngle; }

// The greatest share of constant light's irradiance that a cone about `axis` can hide: its solid angle times the greatest cosine in it.
float greatestShare(Cone cone, vec3 n)
{
    if (cone.all)
        return 1.0;
    float elevation = asin(clamp(dot(cone.axis, n), -1.0, 1.0));
    float cosine = sin(clamp(elevation + cone.halfAngle, 0.0, 1.5707963));
    return 2.0 * (1.0 - cone.cosine) * cosine; // solid angle / pi
}

#endif
