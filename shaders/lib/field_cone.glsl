// How much of a sphere is seen past a signed distance field, by cones (Ban, Balint, Valasek 2020, as corrected in methods/sdf-cones.md).
// The approximation: what a cone meets at its narrowest is taken for a rectangle, in a part of the light for one straight edge and what is
// seen past those beyond it. Needs lib/field.glsl.
#ifndef LIB_FIELD_CONE_GLSL
#define LIB_FIELD_CONE_GLSL

#include "lib/field_march.glsl"
#include "lib/hemisphere.glsl"

const uint kFieldMostCones = 16u;

// Share of a cap that a plane through its apex leaves clear: `m` is the sine of the plane's angle to the axis as a share of `sine`, that of
// the cap's half angle; 1 is clear. A disc's share and the next term of its series: off by 0.002 at most while `sine` is under 0.5.
float capCoverage(float m, float sine)
{
    m = clamp(m, -1.0, 1.0);
    float side = sqrt(max((1.0 - m) * (1.0 + m), 0.0));
    return clamp(0.5 + (m * side + atan(m, side)) / kPi - m * side * side * side * sine * sine / kTau, 0.0, 1.0);
}

// What every method settles before it divides: inside a solid all is dark, inside the light all is lit.
struct FieldReceiver
{
    vec3 axis; // towards the light's centre, unit
    float distanceLight; // metres, to its centre
    float distance; // of the field
    float settled; // the share that is seen where it is known already, else -1
};

FieldReceiver fieldReceiver(FieldsBlock fields, vec3 p, vec3 centre, float radius)
{
    vec3 to = centre - p;
    float distanceLight = length(to), f = fieldDistance(fields, p);
    float settled = !(f > 0.0) ? 0.0 : distanceLight <= radius * (1.0 + 1.0e-6) ? 1.0 : -1.0;
    return FieldReceiver(to / max(distanceLight, 1.0e-20), distanceLight, f, settled);
}

// Places and radii of the cones that share a disc, as shares of its radius: of rings that err least for one straight edge anywhere.
vec3 subConePlace(uint k, uint count)
{
    if (count == 4u)
        return vec3(0.6 * cos(kTau * (float(k) + 0.3) / 4.0), 0.6 * sin(kTau * (float(k) + 0.3) / 4.0), 0.5);
    uint inRing = count == 7u ? 6u : k < 6u ? 5u : 10u;
    float turn = kTau * (float(k < 6u ? k : k - 6u) + 0.3) / float(inRing);
    float off = k == 0u ? 0.0 : count == 7u ? 0.7 : k < 6u ? 0.449 : 0.802;
    return vec3(off * cos(turn), off * sin(turn), count == 7u ? 0.378 : 0.278);
}

// Cones that share a wide one.
struct SubCones
{
    mat3 frame; // across the way to the light, as far as its radius where it is 1 metre away, and along
    FieldCone wide;
    float distanceLight; // metres
    float radius; // of the light, metres
    uint count;
};

FieldCone subCone(SubCones cones, uint k)
{
    vec3 place = subConePlace(k, cones.count), axis = normalize(cones.frame * vec3(place.xy, 1.0));
    return coneToSphere(cones.wide.apex, axis, cones.distanceLight, place.z * cones.radius, 0.0);
}

// In the middle of 7 and of 16 is the wide cone's own axis, which is not gone along again.
FieldMarch marchSubCone(FieldsBlock fields, SubCones cones, uint k, FieldMarch whole, float end, float distanceHere)
{
    FieldCone cone = subCone(cones, k);
    if (k > 0u || cones.count == 4u)
        return marchPart(fields, cone, cones.wide, whole, end, distanceHere);
    whole.least = min(whole.distance / radiusAt(cone, whole.at), 1.0);
    refineLeast(fields, cone, whole);
    searchGap(fields, cone, whole);
    return whole;
}

float subConeLeast[kFieldMostCones];
float subConeAt[kFieldMostCones];
float subConeDistance[kFieldMostCones];

const float kSlopeNudge = 0.3; // of the cone's radius

// How the distance changes across the axis.
struct FieldSlope
{
    vec3 across; // in both ways alike: short on a ridge, in the middle of what is thin
    float greatest; // on one side
};

// How much more it is a step away in either way across the axis.
vec2 changeAside(FieldsBlock fields, vec3 p, mat3 frame, float distanceHere, float step)
{
    float most = distanceHere + abs(step);
    return vec2(fieldDistance(fields, p + frame[0] * step, most), fieldDistance(fields, p + frame[1] * step, most)) - distanceHere;
}

// By steps to both sides; or to one side, which tells as much where there is no ridge, as out of solids. `frame` is across the axis and along.
FieldSlope slopeAcross(FieldsBlock fields, vec3 p, mat3 frame, float distanceHere, float nudge, bool isOneSided)
{
    vec2 rise = changeAside(fields, p, frame, distanceHere, nudge) / nudge, fall = vec2(0.0);
    if (!isOneSided)
        fall = changeAside(fields, p, frame, distanceHere, -nudge) / nudge;
    vec2 across = isOneSided ? rise : 0.5 * (rise - fall);
    return FieldSlope(frame[0] * across.x + frame[1] * across.y, clamp(length(max(abs(rise), abs(fall))), 0.05, 1.0));
}

// 0 on a ridge, where the distance does not say how far an edge is; 1 where it does.
float edgeCertainty(FieldSlope slope) { return clamp((length(slope.across) - 0.1) / 0.3, 0.0, 1.0); }

// Where a cone is narrowest.
struct Narrowest
{
    vec3 point;
    float distance; // of the field there
    float radius; // of the cone there
    mat3 frame; // across its axis and along
};

Narrowest narrowest(SubCones cones, uint k)
{
    FieldCone cone = subCone(cones, k);
    float at = subConeAt[k];
    return Narrowest(cone.apex + cone.axis * at, subConeDistance[k], radiusAt(cone, at), tangentFrame(cone.axis));
}

// What the edges beyond the nearest one add to what is seen: light past the other side of what is thin, less what the next solid hides. The
// distances a radius off the axis, against the way in which the distance rises and along it, say how far from there those edges are.
float seenPastNextEdges(FieldsBlock fields, Narrowest where, vec3 rise, float sine)
{
    vec3 aside = rise * (where.radius * inversesqrt(max(dot(rise, rise), 1.0e-20)));
    float most = where.distance + where.radius;
    vec2 there = vec2(fieldDistance(fields, where.point - aside, most), fieldDistance(fields, where.point + aside, most)) / where.radius;
    return capCoverage(there.x - 1.0, sine) - capCoverage(-1.0 - there.y, sine);
}

// Area that the unit disc shares with the rectangle between its centre and `corner`: negative where one of the corner's coordinates is.
float discToCorner(vec2 corner)
{
    vec2 to = min(abs(corner), 1.0), rim = sqrt((1.0 - to) * (1.0 + to)); // how far from the centre each side leaves the disc
    float area = to.x * min(to.y, rim.x);
    if (to.y > rim.x)
        area += 0.5 * (to.y * rim.y - to.x * rim.x + atan(to.y, rim.y) - atan(rim.x, to.x));
    return sign(corner.x) * sign(corner.y) * area;
}

// Share of the unit disc that the rectangle from `low` to `high` covers; none if it ends before it begins.
float rectangleShare(vec2 low, vec2 high)
{
    high = max(low, high);
    float along = discToCorner(high) - discToCorner(vec2(low.x, high.y));
    return clamp((along - discToCorner(vec2(high.x, low.y)) + discToCorner(low)) / kPi, 0.0, 1.0);
}

// What is seen in a cone past what it meets where it is narrowest, taken for a rectangle. Its near edge is as far off the axis as the distance
// says, in the way in which that rises; the other three, and on a ridge, where nothing rises, the near one too, are where looks a radius away
// find them. `least` is the distance there as a share of the cone's radius.
float seenPastRectangle(FieldsBlock fields, Narrowest where, float least)
{
    const float kInset = 0.5; // of the radius: the ends are looked for from inside of the solid
    const float kThin = 0.3; // of the radius, by half
    FieldSlope slope = slopeAcross(fields, where.point, where.frame, where.distance, kSlopeNudge * where.radius, false);
    float certainty = min(length(slope.across), 1.0), most = where.distance + 2.5 * where.radius;
    vec3 rise = (certainty > 1.0e-6 ? normalize(slope.across) : where.frame[0]) * where.radius, aside = cross(where.frame[2], rise);
    vec3 within = where.point - rise * (certainty * max(least + kInset, 0.0));
    vec4 apart = vec4(fieldDistance(fields, where.point - rise, most), fieldDistance(fields, within - aside, most),
                      fieldDistance(fields, where.point + rise, most), fieldDistance(fields, within + aside, most));
    // A thin sheet aslant, unlike a rod, rises slowly off the axis, and goes on before and behind the looks.
    float sheet = (1.0 - certainty) * clamp((0.8 - slope.greatest) / 0.2, 0.0, 1.0) * clamp(1.0 - abs(least) / kThin, 0.0, 1.0);
    vec4 edge = 1.0 - (1.0 - sheet) * max(apart / where.radius, 0.0);
    return 1.0 - rectangleShare(-edge.xy, vec2(mix(edge.z, -least, certainty), edge.w));
}

// How far a solid that blocks the k-th cone reaches at most into it, as a share of its radius: the nearest cone that is clear says so.
float farthestEdge(SubCones cones, uint k)
{
    float most = 1.0;
    vec3 place = subConePlace(k, cones.count);
    for (uint j = 0u; j < cones.count; ++j) {
        float apart = distance(place.xy, subConePlace(j, cones.count).xy) / place.z;
        most = subConeLeast[j] >= 0.0 ? min(most, apart - subConeLeast[j]) : most;
    }
    return max(most, -subConeLeast[k]);
}

// What is seen in a cone; `sine` of its half angle. Where its middle is blocked: across the edge of a wedge the distance rises by less than
// one goes, and the edge is as much farther. Where it is level, in the middle of what is thin, the solid reaches as far as it can; but a rod,
// from which it rises steeply to both sides, hides no more than a band.
float subConeSeen(FieldsBlock fields, SubCones cones, uint k, float sine)
{
    const float kNearlyAll = 0.7; // where an edge hides less, others are not looked for
    const float kNearlyNone = -0.95; // what is left of a cone that is blocked farther makes no difference
    float least = subConeLeast[k];
    bool isClear = least >= 0.0;
    float seen = least > kNearlyNone ? capCoverage(least, sine) : 0.0;
    if (least > kNearlyAll || least <= kNearlyNone)
        return seen;
    Narrowest where = narrowest(cones, k);
    FieldSlope slope = slopeAcross(fields, where.point, where.frame, where.distance, kSlopeNudge * where.radius, isClear);
    float beyond = seenPastNextEdges(fields, where, slope.across, sine);
    if (isClear)
        return clamp(seen + beyond, 0.0, 1.0);
    float certainty = edgeCertainty(slope), rod = (1.0 - certainty) * clamp((slope.greatest - 0.8) / 0.2, 0.0, 1.0);
    float farthest = farthestEdge(cones, k);
    float pastEdge = capCoverage(-mix(farthest, min(-least / slope.greatest, farthest), certainty), sine);
    float besideRod = seen + 1.0 - capCoverage(-least, sine);
    return max(clamp(pastEdge + certainty * beyond, 0.0, 1.0), rod * besideRod);
}

// All that any of the methods' cones may meet: a little more than the sphere, as those that share it stand out.
FieldsBlock fieldsTowards(FieldsBlock fields, vec3 p, vec3 centre, float radius)
{
    float distanceLight = max(length(centre - p), 1.0e-20);
    return fieldsInCone(fields, coneToSphere(p, (centre - p) / distanceLight, distanceLight, 1.1 * radius, 0.5 * radius), distanceLight);
}

// The default: the span that one wide cone finds something in, and in it a cone each for parts of the light.
float subConeVisibility(FieldsBlock fields, vec3 p, vec3 centre, float radius, uint count)
{
    FieldReceiver at = fieldReceiver(fields, p, centre, radius);
    fields = fieldsTowards(fields, p, centre, radius);
    float end = at.distanceLight - radius;
    if (at.settled >= 0.0 || end <= 0.0)
        return max(at.settled, at.settled < 0.0 ? 1.0 : 0.0);
    float sine = min(radius / at.distanceLight, 0.9999), tangent = sine * inversesqrt(1.0 - sine * sine);
    mat3 frame = tangentFrame(at.axis);
    FieldCone wide = coneToSphere(p, at.axis, at.distanceLight, radius, 0.0);
    FieldMarch whole = marchCone(fields, wide, vec2(0.0, end), at.distance, farthestDistance(fields, p), kWideTolerance);
    if (whole.least >= 1.0 || whole.least <= -1.0)
        return whole.least > 0.0 ? 1.0 : 0.0;
    if (count == 1u)
        return seenPastRectangle(fields, Narrowest(p + at.axis * whole.at, whole.distance, radiusAt(wide, whole.at), frame), whole.least);
    SubCones cones = SubCones(mat3(frame[0] * tangent, frame[1] * tangent, at.axis), wide, at.distanceLight, radius, count);
    for (uint k = 0u; k < count; ++k) {
        FieldMarch part = marchSubCone(fields, cones, k, whole, end, at.distance);
        subConeLeast[k] = max(part.least, -1.0);
        subConeAt[k] = part.at;
        subConeDistance[k] = part.distance;
    }
    float seen = 0.0;
    for (uint k = 0u; k < count; ++k)
        seen += subConeSeen(fields, cones, k, subConePlace(k, count).z * sine);
    return seen / float(count);
}

#endif
