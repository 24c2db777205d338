// How far a ray goes until it meets a signed distance field. Needs lib/field.glsl.
#ifndef LIB_FIELD_RAY_GLSL
#define LIB_FIELD_RAY_GLSL

layout(buffer_reference, scalar) readonly buffer Fields { FieldsBlock block; };

const uint kFieldRayLooks = 1024u; // at most: rays that graze surfaces need many

// A ray on its way through fields.
struct FieldRay
{
    vec3 origin;
    vec3 direction; // unit
    uvec2 groups; // that it may meet, a set
    vec2 way; // metres along it: from where it is to where it leaves the last of them; no way is left where x is not less than y
    float most; // that the distance to them is where it is, metres
    uint looks; // so far
};

// Where a ray is in the box about a group and what it melts with: from x to y metres; nowhere where x is not less than y.
vec2 spanInGroup(FieldGroupBlock group, vec3 origin, vec3 direction)
{
    vec3 inverse = 1.0 / mix(direction, vec3(1.0e-9), lessThan(abs(direction), vec3(1.0e-9))); // finite: 0 times infinity is no number
    vec3 middle = (group.centre - origin) * inverse, reach = (group.halfEdges + group.melt / group.slope) * abs(inverse);
    vec3 enters = middle - reach, leaves = middle + reach;
    return vec2(max(enters.x, max(enters.y, enters.z)), min(leaves.x, min(leaves.y, leaves.z)));
}

// One that meets nothing yet.
FieldRay fieldRay(vec3 origin, vec3 direction) { return FieldRay(origin, direction, uvec2(0u), vec2(kFieldFar, -1.0), kFieldFar, 0u); }

// Adds the g-th group to what the ray may meet, if it meets its box before `far`. What is farther than kFieldFarthestSeen is not met.
void addGroup(FieldsBlock fields, uint g, float far, inout FieldRay ray)
{
    vec2 span = spanInGroup(fieldGroup(fields, g), ray.origin, ray.direction);
    span = vec2(max(span.x, 0.0), min(span.y, min(far, kFieldFarthestSeen)));
    bool isMet = span.x < span.y;
    ray.groups |= isMet ? setOfGroup(g) : uvec2(0u);
    ray.way = isMet ? vec2(min(ray.way.x, span.x), max(ray.way.y, span.y)) : ray.way;
}

// Adds all groups that the ray meets before `far`: each is asked.
void addGroups(FieldsBlock fields, float far, inout FieldRay ray)
{
    for (uint g = 0u; g < fields.groupCount; ++g)
        addGroup(fields, g, far, ray);
}

bool isOnItsWay(FieldRay ray) { return ray.way.x < ray.way.y && ray.looks < kFieldRayLooks; }

// Whether the ray is in a solid; if not it goes on by what is clear, and no less than a ten-thousandth of its way so far.
bool isInField(FieldsBlock fields, inout FieldRay ray)
{
    fields.skipped |= ~ray.groups;
    float f = fieldDistance(fields, ray.origin + ray.direction * ray.way.x, ray.most);
    float step = f < 0.0 ? 0.0 : max(f, 1.0e-5 + 1.0e-4 * ray.way.x);
    ray.way.x += step;
    ray.most = f + step;
    ++ray.looks;
    return f < 0.0;
}

// Negative where it meets none.
float distanceToField(FieldsBlock fields, FieldRay ray)
{
    bool isMet = false;
    while (!isMet && isOnItsWay(ray))
        isMet = isInField(fields, ray);
    return isMet ? ray.way.x : -1.0;
}

#endif
