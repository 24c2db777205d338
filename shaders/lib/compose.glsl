// What is left of the first term when the occluded irradiance is taken away: 0 <= E <= first term, whatever noise and ringing say.
#ifndef LIB_COMPOSE_GLSL
#define LIB_COMPOSE_GLSL

// A thousandth of the first term is rounding, not clamping.
bool isClamped(vec3 firstTerm, vec3 occluded)
{
    vec3 slack = 1.0e-3 * abs(firstTerm) + 1.0e-6;
    return any(greaterThan(occluded, max(firstTerm, vec3(0.0)) + slack)) || any(lessThan(occluded, -slack));
}

vec3 shadowedIrradiance(vec3 firstTerm, vec3 occluded) { return clamp(firstTerm - occluded, vec3(0.0), max(firstTerm, vec3(0.0))); }

#endif
