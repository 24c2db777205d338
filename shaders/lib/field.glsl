// Signed distance to solids that are put together step by step (Hart 1996; golden/README.md, sdf.json). Nowhere does the distance change
// faster than one looks for it: shapes are exact in their own space and scaled by the least of their stretches, and no operation adds to the
// slope. So a ball of that radius is always clear, and what steps by it never goes through anything. FIELD_STRUCTURE, where it is defined, is
// the walk through the steps written out (render/field_structure.h); with HOLDS_STEPS too, each thread reads them once, to have them at hand.
#ifndef LIB_FIELD_GLSL
#define LIB_FIELD_GLSL

#include "shared/field.h"

const float kFieldFar = 1.0e9; // metres: where there is nothing

layout(buffer_reference, scalar) readonly buffer FieldSteps { FieldStepBlock step[]; };
layout(buffer_reference, scalar) readonly buffer FieldSurfaces { FieldSurfaceBlock surface[]; };
layout(buffer_reference, scalar) readonly buffer FieldGroups { FieldGroupBlock group[]; };

uint fieldEvaluations = 0u; // so far

float segmentDistance(vec3 p, float halfLength, float radius)
{
    p.y -= clamp(p.y, -halfLength, halfLength);
    return length(p) - radius;
}

float boxDistance(vec3 p, vec3 halfEdges, float rounding)
{
    vec3 over = abs(p) - halfEdges;
    return length(max(over, 0.0)) + min(max(over.x, max(over.y, over.z)), 0.0) - rounding;
}

float torusDistance(vec3 p, float major, float minor) { return length(vec2(length(p.xz) - major, p.y)) - minor; }

// By its outline in the half plane through the axis: the slanted side and the nearer lid.
float coneDistance(vec3 p, float below, float above, float halfHeight)
{
    vec2 at = vec2(length(p.xz), p.y);
    vec2 side = vec2(above - below, 2.0 * halfHeight), fromBelow = at - vec2(below, -halfHeight);
    vec2 toSide = fromBelow - side * clamp(dot(fromBelow, side) / max(dot(side, side), 1.0e-30), 0.0, 1.0);
    vec2 toLid = vec2(max(at.x - (at.y < 0.0 ? below : above), 0.0), abs(at.y) - halfHeight);
    bool isInside = toLid.y < 0.0 && fromBelow.x * side.y < side.x * fromBelow.y;
    float distance2 = min(dot(toSide, toSide), dot(toLid, toLid));
    return isInside ? -sqrt(distance2) : sqrt(distance2);
}

vec3 fieldLocal(FieldStepBlock s, vec3 p)
{
    return vec3(dot(s.localFromWorld[0].xyz, p) + s.localFromWorld[0].w, dot(s.localFromWorld[1].xyz, p) + s.localFromWorld[1].w,
                dot(s.localFromWorld[2].xyz, p) + s.localFromWorld[2].w);
}

float segmentStep(FieldStepBlock s, vec3 p) { return s.scale * segmentDistance(fieldLocal(s, p), s.size.x, s.size.y); }
float boxStep(FieldStepBlock s, vec3 p) { return s.scale * boxDistance(fieldLocal(s, p), s.size.xyz, s.size.w); }
float torusStep(FieldStepBlock s, vec3 p) { return s.scale * torusDistance(fieldLocal(s, p), s.size.x, s.size.y); }
float coneStep(FieldStepBlock s, vec3 p) { return s.scale * coneDistance(fieldLocal(s, p), s.size.x, s.size.y, s.size.z); }
float planeStep(FieldStepBlock s, vec3 p) { return s.scale * fieldLocal(s, p).y; }

float fieldShape(FieldStepBlock s, vec3 p)
{
    switch (s.shape) {
    case kFieldSegment: return segmentStep(s, p);
    case kFieldBox: return boxStep(s, p);
    case kFieldTorus: return torusStep(s, p);
    case kFieldCone: return coneStep(s, p);
    default: return planeStep(s, p);
    }
}

float unionOf(float before, float own, float blend) { return min(before, own); }
float differenceOf(float before, float own, float blend) { return max(before, -own); }
float intersectionOf(float before, float own, float blend) { return max(before, own); }

// The quadratic smooth minimum: it melts where the distances differ by less than `blend`.
float smoothUnionOf(float before, float own, float blend)
{
    float h = max(blend - abs(before - own), 0.0);
    return min(before, own) - h * h / (4.0 * max(blend, 1.0e-9));
}

float fieldCombined(FieldStepBlock s, float before, float own)
{
    switch (s.operation) {
    case kFieldUnion: return unionOf(before, own, s.blend);
    case kFieldSubtract: return differenceOf(before, own, s.blend);
    case kFieldIntersect: return intersectionOf(before, own, s.blend);
    default: return smoothUnionOf(before, own, s.blend);
    }
}

FieldGroupBlock fieldGroup(FieldsBlock fields, uint g) { return FieldGroups(fields.groups).group[g]; }

FieldStepBlock fieldStep(FieldsBlock fields, uint i) { return FieldSteps(fields.steps).step[i]; }

// holdSteps comes first of all: what a CPU device reads in a loop it gathers each time round.
#ifdef HOLDS_STEPS
#define FIELD_BEGINS
#define FIELD_GROUP(g)
#define FIELD_ENDS
#define FIELD_STEP(i, operation, share, distance) + 1
FieldStepBlock heldSteps[0 FIELD_STRUCTURE];
#undef FIELD_STEP
#define FIELD_STEP(i, operation, share, distance) heldSteps[i] = fieldStep(fields, i);
void holdSteps(FieldsBlock fields) { FIELD_STRUCTURE }
#undef FIELD_STEP
#undef FIELD_ENDS
#undef FIELD_GROUP
#undef FIELD_BEGINS
FieldStepBlock writtenStep(FieldsBlock fields, uint i) { return heldSteps[i]; }
#else
void holdSteps(FieldsBlock fields) {}
FieldStepBlock writtenStep(FieldsBlock fields, uint i) { return fieldStep(fields, i); }
#endif

// Of a sphere about all that the group holds and melts with, metres.
float groupRadius(FieldGroupBlock group) { return group.reach / max(group.slope, 1.0e-6); }

// Sets of 64 groups in a row, as bits: the (g % 64)th stands for the g-th.
const uint kGroupsInSet = 64u;

uvec2 setOfGroup(uint g) { return (g & 32u) == 0u ? uvec2(1u << (g & 31u), 0u) : uvec2(0u, 1u << (g & 31u)); }

bool isLookedAt(FieldsBlock fields, uint g) { return (setOfGroup(g) & ~fields.skipped) != uvec2(0u); }

#ifdef FIELD_STRUCTURE // groups that none of the threads that go together looks at are passed by
#define FIELD_GROUP(g) if (isLookedAt(fields, g)) {
#define FIELD_ENDS }
#endif

// From the g-th on, the first that is looked at; or one that is not, with none before it.
uint nextLookedAt(FieldsBlock fields, uint g)
{
    uint bits = ~((g & 32u) == 0u ? fields.skipped.x : fields.skipped.y) & (~0u << (g & 31u));
    return bits != 0u ? (g & ~31u) + uint(findLSB(bits)) : (g | 31u) + 1u;
}

// What the distance is at most, by the steps of one group near by. Where things are taken away there may be nothing; where steps are written
// out nobody asks.
float farthestDistance(FieldsBlock fields, vec3 p)
{
    float most = kFieldFar;
#ifndef FIELD_STRUCTURE
    uvec2 steps = uvec2(0u);
    float least = kFieldFar;
    for (uint g = nextLookedAt(fields, 0u); g < fields.groupCount; g = nextLookedAt(fields, g + 1u)) {
        FieldGroupBlock group = fieldGroup(fields, g);
        float away = distance(group.centre, p);
        bool isNearer = away < least && isLookedAt(fields, g);
        least = isNearer ? away : least;
        steps = isNearer ? uvec2(group.firstStep, group.endStep) : steps;
    }
    for (uint i = steps.x; i < steps.y; ++i)
        most = min(most, fieldShape(fieldStep(fields, i), p));
#endif
    return fields.takesAway == 0u ? most : kFieldFar;
}

// Whether steps of the group can change the distance, where that is known to be no more than `most`: what is farther by the width over which
// things melt does not, nor what melts with that. What takes away changes it from afar, inside solids.
bool mattersAt(FieldGroupBlock group, vec3 p, float most)
{
    float outside = group.slope * length(max(abs(p - group.centre) - group.halfEdges, 0.0));
    return outside <= max(most, 0.0) + 2.5 * group.melt || group.takesAway != 0u;
}

// Of those that are looked at, in the set that begins with the group `first`.
uvec2 groupsThatMatter(FieldsBlock fields, uint first, vec3 p, float most)
{
    uvec2 set = uvec2(0u);
    uint end = min(first + kGroupsInSet, fields.groupCount);
    most = most * 1.0001 + 1.0e-5; // rounding
    for (uint g = nextLookedAt(fields, first); g < end; g = nextLookedAt(fields, g + 1u))
        set |= isLookedAt(fields, g) && mattersAt(fieldGroup(fields, g), p, most) ? setOfGroup(g) : uvec2(0u);
    return set;
}

// Takes the first out of the set, which is not empty and begins with the group `first`.
FieldGroupBlock takeGroup(FieldsBlock fields, uint first, inout uvec2 set)
{
    uint g = set.x != 0u ? uint(findLSB(set.x)) : 32u + uint(findLSB(set.y));
    set = set.x != 0u ? uvec2(set.x & (set.x - 1u), set.y) : uvec2(0u, set.y & (set.y - 1u));
    return fieldGroup(fields, first + g);
}

// Of all fields together, where that is no more than `most`, else anything that is more: it changes no faster than one goes, so who knows it
// nearby need not ask what is farther. The walk goes step by step through the groups that matter, without a loop for each: CPU devices work
// off a loop's body for nobody too. Written out, all steps that are looked at are worked off, which is faster than to ask whether they matter.
float fieldDistance(FieldsBlock fields, vec3 p, float most)
{
    ++fieldEvaluations;
    float whole = kFieldFar, so = kFieldFar;
#ifdef FIELD_STRUCTURE
#define FIELD_BEGINS whole = min(whole, so); so = kFieldFar;
#define FIELD_STEP(i, operation, share, distance) so = operation(so, distance(writtenStep(fields, i), p), writtenStep(fields, i).blend);
    FIELD_STRUCTURE
#undef FIELD_BEGINS
#undef FIELD_STEP
#else
    uint field = 0u;
    for (uint first = 0u; first < fields.groupCount; first += kGroupsInSet) {
        uvec2 set = groupsThatMatter(fields, first, p, most);
        for (uint i = 0u, end = 0u; i < end || set != uvec2(0u); ++i) {
            if (i == end) {
                FieldGroupBlock group = takeGroup(fields, first, set);
                whole = group.field != field ? min(whole, so) : whole;
                so = group.field != field ? kFieldFar : so;
                field = group.field;
                i = group.firstStep;
                end = group.endStep;
            }
            FieldStepBlock s = fieldStep(fields, i);
            so = fieldCombined(s, so, fieldShape(s, p));
        }
    }
#endif
    return min(whole, so);
}

float fieldDistance(FieldsBlock fields, vec3 p) { return fieldDistance(fields, p, farthestDistance(fields, p)); }

#endif
