// How far a ray goes until it meets a signed distance field. Needs lib/field.glsl.
#ifndef LIB_FIELD_RAY_GLSL
#define LIB_FIELD_RAY_GLSL

#include "lib/field_surface.glsl"

layout(buffer_reference, scalar) readonly buffer Fields { FieldsBlock block; };

// By steps of what is clear, and no less than a ten-thousandth of the way so far; a ray ends where it is inside a solid. Negative where it
// meets none before `far`; what is farther than kFieldFarthestSeen is not met.
float distanceToField(FieldsBlock fields, vec3 origin, vec3 direction, float far)
{
    vec2 way = vec2(0.0, min(far, kFieldFarthestSeen));
    fields = fieldsAlong(fields, origin, direction, way);
    float t = way.x, step = 0.0, last = kFieldFar;
    bool isMet = false;
    for (uint i = 0u; i < 4u * kFieldTraceSteps && t < way.y && !isMet; ++i) {
        last = fieldDistance(fields, origin + direction * t, last + step);
        isMet = last < 0.0;
        step = isMet ? 0.0 : max(last, 1.0e-5 + 1.0e-4 * t);
        t += step;
    }
    return isMet ? t : -1.0;
}

#endif
