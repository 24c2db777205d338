// How much of a sphere is seen past a signed distance field, by cones (Ban, Balint, Valasek 2020, as corrected in methods/sdf-cones.md).
// The approximation: what a cone meets at its narrowest is taken for one straight edge. Needs lib/field.glsl.
#ifndef LIB_FIELD_CONE_GLSL
#define LIB_FIELD_CONE_GLSL

#include "lib/hemisphere.glsl"

const uint kFieldMarchSteps = 256u; // receivers that lights graze need that many
const uint kFieldMostCones = 16u;
const float kWideTolerance = 0.3; // of the radius of a cone that holds all of a light

// Share of a cap that a plane through its apex leaves clear: `m` is the sine of the plane's angle to the axis as a share of `sine`, that of
// the cap's half angle; 1 is clear. A disc's share and the next term of its series: off by 0.002 at most while `sine` is under 0.5.
float flatCapCoverage(float m, float sine)
{
    m = clamp(m, -1.0, 1.0);
    float side = sqrt(max((1.0 - m) * (1.0 + m), 0.0));
    return clamp(0.5 + (m * side + atan(m, side)) / kPi - m * side * side * side * sine * sine / kTau, 0.0, 1.0);
}

// The same of any cap. Where it is nearly flat the formula is a difference of nearly equal angles.
float capCoverage(float m, float sine)
{
    if (sine < 0.2)
        return flatCapCoverage(m, sine);
    m = clamp(m, -1.0, 1.0);
    float side = sqrt(max((1.0 - m) * (1.0 + m), 0.0)), cosine = sqrt(max((1.0 - sine) * (1.0 + sine), 0.0));
    float b = m * sine, cosineB = sqrt(max((1.0 - b) * (1.0 + b), 0.0));
    float x = clamp(-b * cosine / max(cosineB * sine, 1.0e-20), -1.0, 1.0);
    float angle = atan(sqrt(max((1.0 - x) * (1.0 + x), 0.0)), x);
    float clear = (kPi - atan(side, m) - cosine * angle) / (kPi * max(1.0 - cosine, 1.0e-6));
    return clamp(clear, 0.0, 1.0);
}

// From an apex towards a sphere: the radius of the ball that it holds grows by `slope` a metre.
struct FieldCone
{
    vec3 apex;
    vec3 axis; // unit
    float radius; // at the apex, metres
    float slope;
};

float radiusAt(FieldCone cone, float t) { return max(cone.radius + t * cone.slope, 1.0e-7); }

// Two steps in a row, between which the field may fall lower than at either: it changes no faster than one goes.
struct FieldGap
{
    vec2 at; // metres along the axis
    vec2 distance; // there
};

float gapLowest(FieldGap gap) { return 0.5 * (gap.distance.x + gap.distance.y - (gap.at.y - gap.at.x)); }
float gapLowestAt(FieldGap gap) { return 0.5 * (gap.at.x + gap.at.y + gap.distance.x - gap.distance.y); }
float gapLeast(FieldCone cone, FieldGap gap) { return gapLowest(gap) / radiusAt(cone, gapLowestAt(gap)); }

struct FieldMarch
{
    float least; // of distance by radius, at most 1; -1 and less: no light comes through
    float at; // metres along the axis, where that is
    float distance; // there
    vec2 span; // metres along the axis: before and behind it nothing reaches into the cone
    FieldGap gap; // the one that may hold the least
};

// The share of the radius that must be clear for a place to make no difference, once `ratio` of it is known to be clear somewhere. To miss a
// depth tells more than to miss what comes near: where something is cut by the axis its place and its slope count.
float levelOf(float ratio, float tolerance) { return max(ratio - 2.0 * tolerance, clamp(ratio, -1.0, 0.0) - tolerance); }

// The least share of the cone's radius that is clear on the way: to `tolerance` where the axis is blocked, to twice that where it is not. The
// distance at its start is `distanceFrom` or more. Steps go past what is certain and are taken back where two balls do not meet: the farther,
// the more the distance rose on the last (Balint, Valasek 2018).
FieldMarch marchCone(FieldsBlock fields, FieldCone cone, vec2 way, float distanceFrom, float tolerance)
{
    const float kRelaxed = 1.8, kMostRelaxed = 4.0;
    float t = way.x, f = distanceFrom, leastInGap = 1.0, level = levelOf(1.0, tolerance), relaxation = kRelaxed;
    float last = kFieldFar; // `distanceFrom` may be of other groups
    FieldMarch march = FieldMarch(1.0, t, f, way, FieldGap(vec2(t), vec2(f)));
    bool isMet = false, isInside = false;
    for (uint i = 0u; i < kFieldMarchSteps && march.least > -1.0; ++i) {
        float safe = max((f - level * radiusAt(cone, t)) / max(1.0 + level * cone.slope, 0.01), 1.0e-5 + 1.0e-4 * t);
        if (t + safe >= way.y)
            break;
        float next = min(t + relaxation * safe, way.y);
        float g = fieldDistance(fields, cone.apex + cone.axis * next, last + next - t), ratio = g / radiusAt(cone, next);
        FieldGap gap = FieldGap(vec2(t, next), vec2(f, g));
        float inGap = gapLeast(cone, gap), rise = i > 0u ? (g - f) / (next - t) : 0.0;
        march.at = ratio < march.least ? next : march.at;
        march.distance = ratio < march.least ? g : march.distance;
        march.least = min(march.least, ratio);
        level = min(level, levelOf(ratio, tolerance));
        bool isCertain = relaxation == 1.0 || inGap >= level, isIn = ratio < 1.0;
        relaxation = isCertain ? clamp(kRelaxed / (1.0 - rise), 1.0, kMostRelaxed) : 1.0;
        if (!isCertain)
            continue;
        march.gap = inGap < leastInGap ? gap : march.gap;
        leastInGap = min(leastInGap, inGap);
        march.span.x = isIn && !isMet ? t : march.span.x;
        march.span.y = isIn ? way.y : isInside ? next : march.span.y;
        isMet = isMet || isIn;
        isInside = isIn;
        t = next;
        f = last = g;
    }
    return march;
}

// Asks again in the gap where the axis may run through a solid: what is thin would slip through.
void searchGap(FieldsBlock fields, FieldCone cone, inout FieldMarch march)
{
    for (int i = 0; i < 2 && march.least > -1.0 && gapLeast(cone, march.gap) < min(march.least, 0.0); ++i) {
        float t = gapLowestAt(march.gap), f = fieldDistance(fields, cone.apex + cone.axis * t), ratio = f / radiusAt(cone, t);
        if (ratio < march.least) {
            march.least = ratio;
            march.at = t;
            march.distance = f;
        }
        FieldGap before = FieldGap(vec2(march.gap.at.x, t), vec2(march.gap.distance.x, f));
        FieldGap behind = FieldGap(vec2(t, march.gap.at.y), vec2(f, march.gap.distance.y));
        march.gap = gapLowest(before) < gapLowest(behind) ? before : behind;
    }
}

// The march of a cone that shares the wide one in which `found` was met.
FieldMarch marchPart(FieldsBlock fields, FieldCone part, FieldCone wide, FieldMarch found, float end, float distanceHere, float tolerance)
{
    float start = found.span.x, apart = start * distance(wide.axis, part.axis);
    float atLeast = start > 0.0 ? radiusAt(wide, start) - apart : distanceHere;
    FieldMarch march = marchCone(fields, part, vec2(start, min(found.span.y, end)), atLeast, tolerance);
    searchGap(fields, part, march);
    return march;
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

FieldCone coneToSphere(vec3 p, vec3 axis, float distanceLight, float radius, float radiusHere)
{
    return FieldCone(p, axis, radiusHere, min((radius - radiusHere) / distanceLight, 0.9999));
}

// Looks at the groups alone that reach into the cone between the apex and `end` metres along it.
FieldsBlock fieldsInCone(FieldsBlock fields, FieldCone cone, float end)
{
    float cosine = sqrt((1.0 - cone.slope) * (1.0 + cone.slope));
    uint near = 0u;
    for (uint g = 0u; g < fields.groupCount; ++g) {
        FieldGroupBlock group = fieldGroup(fields, g);
        vec3 to = group.centre - cone.apex;
        float along = dot(to, cone.axis), aside = sqrt(max(dot(to, to) - along * along, 0.0));
        // The ball in the cone whose surface is nearest: where the way there is at right angles to the cone's side.
        float t = clamp(along + aside * cone.slope / cosine, 0.0, end);
        float apart = length(vec2(aside, along - t)) - cone.radius - cone.slope * t;
        near |= apart < groupRadius(group) ? 1u << (g & 31u) : 0u;
    }
    fields.skipped |= ~near;
    return fields;
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
    float radius = place.z * cones.radius;
    return coneToSphere(cones.wide.apex, axis, cones.distanceLight, radius, min(cones.wide.radius, 0.5 * radius));
}

// In the middle of 7 and of 16 is the wide cone's own axis, which is not gone along again.
FieldMarch marchSubCone(FieldsBlock fields, SubCones cones, uint k, FieldMarch whole, float end, float distanceHere)
{
    FieldCone cone = subCone(cones, k);
    if (k > 0u || cones.count == 4u)
        return marchPart(fields, cone, cones.wide, whole, end, distanceHere, 0.45);
    whole.least = min(whole.distance / radiusAt(cone, whole.at), 1.0);
    searchGap(fields, cone, whole);
    return whole;
}

float subConeLeast[kFieldMostCones];
float subConeAt[kFieldMostCones];
float subConeDistance[kFieldMostCones];

// How the distance changes across the axis, by steps to both sides.
struct FieldSlope
{
    vec3 across; // in both ways alike: short on a ridge, in the middle of what is thin
    float greatest; // on one side
};

FieldSlope slopeAcross(FieldsBlock fields, vec3 p, vec3 axis, float distanceHere, float nudge)
{
    mat3 frame = tangentFrame(axis);
    vec2 change[2] = vec2[2](vec2(0.0), vec2(0.0));
    for (int i = 0; i < 4; ++i) {
        float there = fieldDistance(fields, p + frame[i & 1] * (i < 2 ? nudge : -nudge), distanceHere + nudge);
        change[i >> 1][i & 1] = (there - distanceHere) / nudge;
    }
    vec2 across = 0.5 * (change[0] - change[1]);
    return FieldSlope(frame[0] * across.x + frame[1] * across.y, clamp(length(max(abs(change[0]), abs(change[1]))), 0.05, 1.0));
}

// 0 on a ridge, where the distance does not say how far an edge is; 1 where it does.
float edgeCertainty(FieldSlope slope) { return clamp((length(slope.across) - 0.1) / 0.3, 0.0, 1.0); }

const float kSlopeNudge = 0.3; // of the cone's radius

// What is seen in a cone that is blocked in its middle; `sine` of its half angle. Across the edge of a wedge the distance rises by less than
// one goes, and the edge is as much farther. Where it is level, in the middle of what is thin, the nearest cone that is clear says how far
// the solid reaches at most; but a rod, from which it rises steeply to both sides, hides no more than a band.
float blockedSubConeSeen(FieldsBlock fields, SubCones cones, uint k, float sine)
{
    float depth = -subConeLeast[k], most = 1.0;
    vec3 place = subConePlace(k, cones.count);
    for (uint j = 0u; j < cones.count; ++j) {
        float apart = distance(place.xy, subConePlace(j, cones.count).xy) / place.z;
        most = subConeLeast[j] >= 0.0 ? min(most, apart - subConeLeast[j]) : most;
    }
    most = max(most, depth);
    FieldCone cone = subCone(cones, k);
    vec3 at = cone.apex + cone.axis * subConeAt[k];
    FieldSlope slope = slopeAcross(fields, at, cone.axis, subConeDistance[k], kSlopeNudge * radiusAt(cone, subConeAt[k]));
    float certainty = edgeCertainty(slope), rod = (1.0 - certainty) * clamp((slope.greatest - 0.8) / 0.2, 0.0, 1.0);
    float pastEdge = flatCapCoverage(-mix(most, min(depth / slope.greatest, most), certainty), sine);
    float besideRod = flatCapCoverage(-depth, sine) + 1.0 - flatCapCoverage(depth, sine);
    return max(pastEdge, rod * besideRod);
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
    float radiusHere = min(at.distance, 0.5 * radius), end = at.distanceLight - radius;
    if (at.settled >= 0.0 || end <= 0.0)
        return max(at.settled, at.settled < 0.0 ? 1.0 : 0.0);
    float sine = min(radius / at.distanceLight, 0.9999), tangent = sine * inversesqrt(1.0 - sine * sine);
    mat3 frame = tangentFrame(at.axis);
    FieldCone wide = coneToSphere(p, at.axis, at.distanceLight, radius, radiusHere);
    FieldMarch whole = marchCone(fields, wide, vec2(0.0, end), at.distance, kWideTolerance);
    if (whole.least >= 1.0 || whole.least <= -1.0 || count == 1u)
        return capCoverage(whole.least, sine);
    SubCones cones = SubCones(mat3(frame[0] * tangent, frame[1] * tangent, at.axis), wide, at.distanceLight, radius, count);
    for (uint k = 0u; k < count; ++k) {
        FieldMarch part = marchSubCone(fields, cones, k, whole, end, at.distance);
        subConeLeast[k] = max(part.least, -1.0);
        subConeAt[k] = part.at;
        subConeDistance[k] = part.distance;
    }
    float seen = 0.0;
    for (uint k = 0u; k < count; ++k) {
        float least = subConeLeast[k], sineHere = subConePlace(k, count).z * sine;
        // What is left of a cone that is blocked farther makes no difference.
        bool isBlocked = least < 0.0 && least > -0.95;
        seen += isBlocked ? blockedSubConeSeen(fields, cones, k, sineHere) : flatCapCoverage(least, sineHere);
    }
    return seen / float(count);
}

#endif
