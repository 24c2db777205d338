// Where a ray meets a signed distance field, which way it faces there, and what it is made of. Needs lib/field.glsl.
#ifndef LIB_FIELD_SURFACE_GLSL
#define LIB_FIELD_SURFACE_GLSL

const uint kFieldTraceSteps = 256u;

struct FieldHit
{
    float at; // metres along the ray; negative: nothing is hit
    uint steps;
};

// Sphere tracing (Hart 1996) by steps longer than what is clear, taken back where two balls in a row do not meet (Keinert et al. 2014). A ray
// that comes as near as `width` a metre of its way has met the surface.
FieldHit traceField(FieldsBlock fields, vec3 origin, vec3 direction, float from, float to, float width)
{
    const float kRelaxed = 1.5;
    float t = from, before = 0.0, step = 0.0, relaxation = kRelaxed, last = kFieldFar;
    FieldHit hit = FieldHit(-1.0, 0u);
    for (bool isDone = !(from < to); !isDone && hit.steps < kFieldTraceSteps; ++hit.steps) {
        float f = fieldDistance(fields, origin + direction * t, last + abs(step));
        last = f;
        // The ball before reaches to where it began plus `before`; if this one does not touch it, something may lie between.
        bool isPast = relaxation > 1.0 && abs(f) + before < step;
        bool isMet = !isPast && f < width * t;
        hit.at = isMet ? t : -1.0;
        step = isPast ? before - step : max(relaxation * f, 0.5 * width * t);
        relaxation = isPast ? 1.0 : kRelaxed;
        before = isPast ? before : f;
        isDone = isMet || (!isPast && t > to);
        t += isDone ? 0.0 : step;
    }
    return hit;
}

// Along the gradient, by differences over `width` metres at a tetrahedron's corners: four of them see no side before another. The point is
// no farther than twice that from the surface. Anything where it is not wanted, without the work.
vec3 fieldNormal(FieldsBlock fields, vec3 p, float width, bool isWanted)
{
    vec3 sum = vec3(0.0);
    int corners = isWanted ? 4 : 0;
    for (int i = 0; i < corners; ++i) {
        vec3 corner = vec3(((i + 3) >> 1) & 1, (i >> 1) & 1, i & 1) * 2.0 - 1.0;
        sum += corner * fieldDistance(fields, p + corner * width, 4.0 * width);
    }
    return dot(sum, sum) > 0.0 ? normalize(sum) : vec3(0.0, 1.0, 0.0);
}

FieldSurfaceBlock mixedSurface(FieldSurfaceBlock a, FieldSurfaceBlock b, float share)
{
    return FieldSurfaceBlock(mix(a.albedo, b.albedo, share), mix(a.roughness, b.roughness, share), mix(a.metallic, b.metallic, share),
                             mix(a.specular, b.specular, share));
}

// How much of a step's own surface shows where the distances are these; melted ones change over as the distance does.
float unionShare(float before, float own, float blend) { return own < before ? 1.0 : 0.0; }
float differenceShare(float before, float own, float blend) { return -own > before ? 1.0 : 0.0; }
float intersectionShare(float before, float own, float blend) { return own > before ? 1.0 : 0.0; }
float smoothUnionShare(float before, float own, float blend)
{
    return clamp(0.5 + (before - own) / (2.0 * max(blend, 1.0e-9)), 0.0, 1.0);
}

float ownShare(FieldStepBlock s, float before, float own)
{
    switch (s.operation) {
    case kFieldUnion: return unionShare(before, own, s.blend);
    case kFieldSubtract: return differenceShare(before, own, s.blend);
    case kFieldIntersect: return intersectionShare(before, own, s.blend);
    default: return smoothUnionShare(before, own, s.blend);
    }
}

// At a point no farther from the surface than `width`, metres. Anything where it is not wanted, without the work.
FieldSurfaceBlock fieldSurface(FieldsBlock fields, vec3 p, float width, bool isWanted)
{
    FieldSurfaceBlock none = FieldSurfaceBlock(vec3(0.0), 1.0, 0.0, 0.0), shown = none, made = none;
    float whole = kFieldFar, so = kFieldFar, own;
#ifdef FIELD_STRUCTURE
#define FIELD_BEGINS shown = mixedSurface(shown, made, so < whole ? 1.0 : 0.0); whole = min(whole, so); so = kFieldFar;
#define FIELD_STEP(i, operation, share, distance) \
    own = distance(writtenStep(fields, i), p); \
    made = mixedSurface(made, FieldSurfaces(fields.surfaces).surface[i], share(so, own, writtenStep(fields, i).blend)); \
    so = operation(so, own, writtenStep(fields, i).blend);
    FIELD_STRUCTURE
#undef FIELD_BEGINS
#undef FIELD_STEP
#else
    uint groupCount = isWanted ? fields.groupCount : 0u, field = 0u;
    for (uint first = 0u; first < groupCount; first += kGroupsInSet) {
        uvec2 set = groupsThatMatter(fields, first, p, width);
        for (uint i = 0u, end = 0u; i < end || set != uvec2(0u); ++i) {
            if (i == end) {
                FieldGroupBlock group = takeGroup(fields, first, set);
                if (group.field != field) {
                    shown = mixedSurface(shown, made, so < whole ? 1.0 : 0.0);
                    whole = min(whole, so);
                    so = kFieldFar;
                }
                field = group.field;
                i = group.firstStep;
                end = group.endStep;
            }
            FieldStepBlock s = fieldStep(fields, i);
            own = fieldShape(s, p);
            made = mixedSurface(made, FieldSurfaces(fields.surfaces).surface[i], ownShare(s, so, own));
            so = fieldCombined(s, so, own);
        }
    }
#endif
    return mixedSurface(shown, made, so < whole ? 1.0 : 0.0);
}

#endif
