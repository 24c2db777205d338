// Convex cones from a point as spherical polygons, in numbered places of fixed size: cut by planes through the point, and integrated
// against the clamped cosine (methods/area-shadows.md, Guards). Needs POLYGON_PLACES and POLYGON_CORNERS.
#ifndef LIB_CONE_POLYGON_GLSL
#define LIB_CONE_POLYGON_GLSL

#include "lib/angle.glsl"

// xyz: unit, counter-clockwise seen from the point. w: z of the inward unit normal of the plane to the next corner.
#ifndef IN_SCRATCH // the largest arrays may lie in memory
vec4 polygonCorners[POLYGON_PLACES * POLYGON_CORNERS];
#endif
int cornerCounts[POLYGON_PLACES];

const float kOnPlane = 2.0e-7; // a corner this near a plane, of unit vectors, lies on it: rounding of four products

// Counts are kept by who adds corners, as CPU devices pay for memory that threads find at places of their own.
void addCorner(int place, inout int count, vec3 direction, float planeZ)
{
    if (count < POLYGON_CORNERS)
        polygonCorners[place * POLYGON_CORNERS + count++] = vec4(direction, planeZ);
}

// A cut adds one corner at most.
bool hasRoomForCut(int place) { return cornerCounts[place] < POLYGON_CORNERS; }

// A plane as a polygon meets it.
struct Crossing
{
    vec3 plane;
    bool hasFront; // some corner is in front of it
    bool hasBehind;
    float dropped; // 1: none is in front after all; -1: none is behind; 0: as they are
};

// Positive in front; 0 for what lies on the plane.
float sideOf(vec3 plane, vec3 corner)
{
    float side = dot(plane, corner);
    return abs(side) <= kOnPlane ? 0.0 : side;
}

// A convex polygon meets a plane at most twice: more changes of side come from rounding, and the weaker side is no side.
Crossing crossingOf(int place, vec3 plane)
{
    int changes = 0, count = cornerCounts[place];
    float last = 0.0, first = 0.0, mostInFront = 0.0, mostBehind = 0.0;
    for (int i = 0; i < count; ++i) {
        float side = sideOf(plane, polygonCorners[place * POLYGON_CORNERS + i].xyz);
        mostInFront = max(mostInFront, side);
        mostBehind = max(mostBehind, -side);
        changes += side * last < 0.0 ? 1 : 0;
        first = first == 0.0 ? side : first;
        last = side == 0.0 ? last : side;
    }
    changes += first * last < 0.0 ? 1 : 0;
    float dropped = changes <= 2 ? 0.0 : mostInFront >= mostBehind ? -1.0 : 1.0;
    return Crossing(plane, mostInFront > 0.0, mostBehind > 0.0, dropped);
}

bool isCut(Crossing crossing) { return crossing.hasFront && crossing.hasBehind; }

// Computed from the end in front, always, so that two polygons share the same corner.
vec3 cornerBetween(vec3 front, float frontSide, vec3 behind, float behindSide)
{
    vec3 between = front * -behindSide + behind * frontSide;
    return between * inversesqrt(max(dot(between, between), 1.0e-30)); // zero for ends that are opposite
}

// The part of `from` in front of the plane goes to `front`, and where `wantsBehind` the rest to `behind`, else that is left alone: three
// different places. Unless `isCrossed` nothing happens: loops that do not go round are what spares CPU devices the work.
void cut(int from, Crossing crossing, int front, int behind, bool wantsBehind, bool isCrossed)
{
    int count = isCrossed ? cornerCounts[from] : 0, base = from * POLYGON_CORNERS, frontCount = 0, behindCount = 0;
    vec4 corner = polygonCorners[base];
    float a = sideOf(crossing.plane, corner.xyz);
    a = a * crossing.dropped > 0.0 ? 0.0 : a;
    for (int i = 0; i < count; ++i) {
        vec4 next = polygonCorners[base + (i + 1 < count ? i + 1 : 0)];
        float b = sideOf(crossing.plane, next.xyz);
        b = b * crossing.dropped > 0.0 ? 0.0 : b;
        if (a >= 0.0)
            addCorner(front, frontCount, corner.xyz, a > 0.0 || b >= 0.0 ? corner.w : crossing.plane.z);
        if (wantsBehind && a <= 0.0)
            addCorner(behind, behindCount, corner.xyz, a < 0.0 || b <= 0.0 ? corner.w : -crossing.plane.z);
        if (a * b < 0.0) {
            vec3 at = a > 0.0 ? cornerBetween(corner.xyz, a, next.xyz, b) : cornerBetween(next.xyz, b, corner.xyz, a);
            addCorner(front, frontCount, at, a > 0.0 ? crossing.plane.z : corner.w);
            if (wantsBehind)
                addCorner(behind, behindCount, at, a > 0.0 ? corner.w : -crossing.plane.z);
        }
        corner = next;
        a = b;
    }
    if (isCrossed)
        cornerCounts[front] = frontCount < 3 ? 0 : frontCount;
    if (isCrossed && wantsBehind)
        cornerCounts[behind] = behindCount < 3 ? 0 : behindCount;
}

// theta / sin theta - 1 for the arc of a chord, by its square: the series of asin(sqrt s) / sqrt(s (1 - s)), s = chord^2 / 4.
float curvatureOfShortArc(float chord2)
{
    float s = 0.25 * chord2;
    return s * (2.0 / 3.0 +
                s * (8.0 / 15.0 +
                     s * (16.0 / 35.0 +
                          s * (128.0 / 315.0 +
                               s * (256.0 / 693.0 + s * (1024.0 / 3003.0 + s * (2048.0 / 6435.0 + s * 32768.0 / 109395.0)))))));
}

// Share of the hemisphere's cosine-weighted solid angle that the polygon fills, 0..1, where all of it has z >= 0. By the sum over its edges
// about its first corner, which keeps the digits of a small one, plus what their curvature adds; no acos, which loses half of them.
// Not `isWanted`: 0.
float formFactor(int place, bool isWanted)
{
    int base = place * POLYGON_CORNERS;
    int count = isWanted && cornerCounts[place] >= 3 ? cornerCounts[place] : 0;
    vec2 centre = polygonCorners[base].xy;
    float flat_ = 0.0, curved = 0.0;
    vec4 a = polygonCorners[base];
    for (int i = 0; i < count; ++i) {
        vec4 b = polygonCorners[base + (i + 1 < count ? i + 1 : 0)];
        vec2 p = a.xy - centre, q = b.xy - centre;
        flat_ += p.x * q.y - p.y * q.x;
        vec3 chord = b.xyz - a.xyz;
        float chord2 = dot(chord, chord), crossZ = a.x * chord.y - a.y * chord.x;
        if (chord2 < 0.3) {
            curved += curvatureOfShortArc(chord2) * crossZ;
        } else {
            float angle = angleBetween(a.xyz, b.xyz);
            // Ends that are nearly opposite have no cross product to speak of; the plane of their edge is known. A crossing between such ends
            // may have no direction, and then no cross product at all.
            float sine = max(length(cross(a.xyz, chord)), 1.0e-6);
            curved += chord2 < 3.8 ? (angle / sine - 1.0) * crossZ : angle * a.w - crossZ;
        }
        a = b;
    }
    return (flat_ + curved) * 0.15915494309; // 1 / (2 pi)
}

#endif
