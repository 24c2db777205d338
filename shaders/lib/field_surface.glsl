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
FieldHit traceField(Field field, vec3 origin, vec3 direction, float from, float to, float width)
{
    const float kRelaxed = 1.5;
    float t = from, before = 0.0, step = 0.0, relaxation = kRelaxed;
    FieldHit hit = FieldHit(-1.0, 0u);
    for (bool isDone = !(from < to); !isDone && hit.steps < kFieldTraceSteps; ++hit.steps) {
        float f = fieldDistance(field, origin + direction * t);
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

// Along the gradient, by differences over `width` metres at a tetrahedron's corners: four of them see no side before another.
vec3 fieldNormal(Field field, vec3 p, float width)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec3 corner = vec3(((i + 3) >> 1) & 1, (i >> 1) & 1, i & 1) * 2.0 - 1.0;
        sum += corner * fieldDistance(field, p + corner * width);
    }
    return dot(sum, sum) > 0.0 ? normalize(sum) : vec3(0.0, 1.0, 0.0);
}

FieldSurfaceBlock mixedSurface(FieldSurfaceBlock a, FieldSurfaceBlock b, float share)
{
    return FieldSurfaceBlock(mix(a.albedo, b.albedo, share), mix(a.roughness, b.roughness, share), mix(a.metallic, b.metallic, share),
                             mix(a.specular, b.specular, share));
}

// How much of a step's own surface shows where the distances are these; melted ones change over as the distance does.
float surfaceShare(FieldStepBlock s, float before, float own)
{
    switch (s.operation) {
    case kFieldUnion: return own < before ? 1.0 : 0.0;
    case kFieldSubtract: return -own > before ? 1.0 : 0.0;
    case kFieldIntersect: return own > before ? 1.0 : 0.0;
    default: return clamp(0.5 + (before - own) / (2.0 * max(s.blend, 1.0e-9)), 0.0, 1.0);
    }
}

// `surfaces` are as many as steps.
FieldSurfaceBlock fieldSurface(Field field, uint64_t surfaces, vec3 p)
{
    FieldSurfaceBlock none = FieldSurfaceBlock(vec3(0.0), 1.0, 0.0, 0.0), shown = none, made = none;
    float whole = kFieldFar, so = kFieldFar;
    for (uint i = 0u; i <= field.count; ++i) {
        bool isOver = i == field.count;
        uint index = isOver ? 0u : field.list != 0ul ? FieldLists(field.list).step[i] : field.first + i;
        FieldStepBlock s = FieldSteps(field.steps).step[index];
        if (isOver || (s.flags & kFieldBegins) != 0u) {
            shown = mixedSurface(shown, made, so < whole ? 1.0 : 0.0);
            whole = min(whole, so);
            so = kFieldFar;
            made = none;
        }
        if (isOver)
            break;
        float own = fieldShape(s, p);
        made = mixedSurface(made, FieldSurfaces(surfaces).surface[index], surfaceShare(s, so, own));
        so = fieldCombined(s, so, own);
    }
    return shown;
}

#endif
