// The way along a cone through a signed distance field, and the least share of its radius that is clear on it (Ban, Balint, Valasek 2020,
// as corrected in methods/sdf-cones.md). Needs lib/field.glsl.
#ifndef LIB_FIELD_MARCH_GLSL
#define LIB_FIELD_MARCH_GLSL

const uint kFieldMarchSteps = 256u; // receivers that lights graze need that many
const float kWideTolerance = 0.2; // of the radius of a cone that holds all of a light
const float kPartTolerance = 0.45; // of the radius of one that holds a part

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
    FieldGap beside; // the looks before and behind the least; at kFieldFar while there is none behind
};

// `radiusHere` at its apex: a cone that is as wide as what is clear there takes what stands near by for narrow.
FieldCone coneToSphere(vec3 p, vec3 axis, float distanceLight, float radius, float radiusHere)
{
    return FieldCone(p, axis, radiusHere, min((radius - radiusHere) / distanceLight, 0.9999));
}

// Looks at the groups alone that reach into the cone between the apex and `end` metres along it.
FieldsBlock fieldsInCone(FieldsBlock fields, FieldCone cone, float end)
{
    float cosine = sqrt((1.0 - cone.slope) * (1.0 + cone.slope));
    uvec2 near = uvec2(0u);
    for (uint g = 0u; g < fields.groupCount; ++g) {
        FieldGroupBlock group = fieldGroup(fields, g);
        vec3 to = group.centre - cone.apex;
        float along = dot(to, cone.axis), aside = sqrt(max(dot(to, to) - along * along, 0.0));
        // The ball in the cone whose surface is nearest: where the way there is at right angles to the cone's side.
        float t = clamp(along + aside * cone.slope / cosine, 0.0, end);
        float apart = length(vec2(aside, along - t)) - cone.radius - cone.slope * t;
        near |= apart < groupRadius(group) ? setOfGroup(g) : uvec2(0u);
    }
    fields.skipped |= ~near;
    return fields;
}

// The share of the radius that must be clear for a place to make no difference, once `ratio` of it is known to be clear somewhere. To miss a
// depth tells more than to miss what comes near: where something is cut by the axis its place and its slope count.
float levelOf(float ratio, float tolerance) { return max(ratio - 2.0 * tolerance, clamp(ratio, -1.0, 0.0) - tolerance); }

// What is less than the least takes its place, which is beside it from then on.
void addLook(inout FieldMarch march, float at, float found, float ratio)
{
    bool isLess = ratio < march.least, isBehind = at > march.at;
    vec2 beside = isLess ? vec2(march.at, march.distance) : vec2(at, found);
    bool isBefore = isBehind == isLess;
    if (isBefore && beside.x >= march.beside.at.x) {
        march.beside.at.x = beside.x;
        march.beside.distance.x = beside.y;
    }
    if (!isBefore && beside.x < march.beside.at.y) {
        march.beside.at.y = beside.x;
        march.beside.distance.y = beside.y;
    }
    if (isLess) {
        march.beside.at.y = at < march.beside.at.y ? march.beside.at.y : kFieldFar;
        march.at = at;
        march.distance = found;
        march.least = ratio;
    }
}

// The least share of the cone's radius that is clear on the way: to `tolerance` where the axis is blocked, to twice that where it is not. The
// distance at its start is `distanceFrom` or more, and to the groups that are looked at no more than `most`. Steps go past what is certain and
// are taken back where two balls do not meet: the farther, the more the distance rose on the last (Balint, Valasek 2018).
FieldMarch marchCone(FieldsBlock fields, FieldCone cone, vec2 way, float distanceFrom, float most, float tolerance)
{
    const float kRelaxed = 1.8, kMostRelaxed = 4.0;
    float t = way.x, f = distanceFrom, leastInGap = 1.0, level = levelOf(1.0, tolerance), relaxation = kRelaxed;
    float last = most;
    FieldMarch march = FieldMarch(1.0, t, f, way, FieldGap(vec2(t), vec2(f)), FieldGap(vec2(t, kFieldFar), vec2(f)));
    bool isMet = false, isInside = false;
    for (uint i = 0u; i < kFieldMarchSteps && march.least > -1.0; ++i) {
        float safe = max((f - level * radiusAt(cone, t)) / max(1.0 + level * cone.slope, 0.01), 1.0e-5 + 1.0e-4 * t);
        if (t + safe >= way.y)
            break;
        float next = min(t + relaxation * safe, way.y);
        float g = fieldDistance(fields, cone.apex + cone.axis * next, last + next - t), ratio = g / radiusAt(cone, next);
        FieldGap gap = FieldGap(vec2(t, next), vec2(f, g));
        float inGap = gapLeast(cone, gap), rise = i > 0u ? (g - f) / (next - t) : 0.0;
        addLook(march, next, g, ratio);
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

// Looks again where a parabola through the least and the looks beside it is lowest. Steps are as long as the tolerance allows: what they find
// would change from one receiver to the next, and show as bands.
void refineLeast(FieldsBlock fields, FieldCone cone, inout FieldMarch march)
{
    const float kEnough = 0.1; // of the radius
    for (int i = 0; i < 2 && abs(march.least) < 1.0 && march.beside.at.y < kFieldFar; ++i) {
        FieldGap before = FieldGap(vec2(march.beside.at.x, march.at), vec2(march.beside.distance.x, march.distance));
        FieldGap behind = FieldGap(vec2(march.at, march.beside.at.y), vec2(march.distance, march.beside.distance.y));
        vec2 apart = vec2(before.at.y - before.at.x, behind.at.y - behind.at.x);
        vec2 there = vec2(before.distance.x / radiusAt(cone, before.at.x), behind.distance.y / radiusAt(cone, behind.at.y));
        vec2 rise = max(there - march.least, 0.0);
        float curvature = rise.x * apart.y + rise.y * apart.x;
        if (min(gapLeast(cone, before), gapLeast(cone, behind)) > march.least - kEnough || !(curvature > 0.0))
            break;
        float t = march.at + 0.5 * (rise.x * apart.y * apart.y - rise.y * apart.x * apart.x) / curvature;
        float f = fieldDistance(fields, cone.apex + cone.axis * t, march.distance + abs(t - march.at));
        addLook(march, t, f, f / radiusAt(cone, t));
    }
}

// Asks again in the gap where the axis may run through a solid: what is thin would slip through.
void searchGap(FieldsBlock fields, FieldCone cone, inout FieldMarch march)
{
    for (int i = 0; i < 2 && march.least > -1.0 && gapLeast(cone, march.gap) < min(march.least, 0.0); ++i) {
        float t = gapLowestAt(march.gap), most = march.gap.distance.x + t - march.gap.at.x;
        float f = fieldDistance(fields, cone.apex + cone.axis * t, most), ratio = f / radiusAt(cone, t);
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
FieldMarch marchPart(FieldsBlock fields, FieldCone part, FieldCone wide, FieldMarch found, float end, float distanceHere)
{
    float start = found.span.x, apart = start * distance(wide.axis, part.axis);
    float atLeast = start > 0.0 ? radiusAt(wide, start) - apart : distanceHere;
    float most = found.distance + distance(part.axis * start, wide.axis * found.at);
    FieldMarch march = marchCone(fields, part, vec2(start, min(found.span.y, end)), atLeast, most, kPartTolerance);
    refineLeast(fields, part, march);
    searchGap(fields, part, march);
    return march;
}

#endif
