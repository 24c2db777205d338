// Whether a signed distance field is in a ray's way. Needs lib/field.glsl.
#ifndef LIB_FIELD_RAY_GLSL
#define LIB_FIELD_RAY_GLSL

#include "lib/field_surface.glsl"

// By steps of what is clear, and no less than a ten-thousandth of the way; a ray ends where it is inside a solid.
bool fieldBlocks(FieldsBlock fields, vec3 origin, vec3 direction, float before)
{
    vec2 way = vec2(0.0, before);
    fields = fieldsAlong(fields, origin, direction, 0.0, way);
    float t = way.x;
    bool isBlocked = false;
    for (uint i = 0u; i < 4u * kFieldTraceSteps && t < way.y && !isBlocked; ++i) {
        float f = fieldDistance(fields, origin + direction * t);
        isBlocked = f < 0.0;
        t += max(f, 1.0e-4 * before);
    }
    return isBlocked;
}

#endif
