// Angles as exact as floats are.
#ifndef LIB_ANGLE_GLSL
#define LIB_ANGLE_GLSL

const float kHalfPi = 1.57079632679;

// Radians for x in 0..1, to a few units in the last place; drivers may be off by 1e-4 and more. A fit of asin up to 1/2 (relative error
// 2e-8) and the half-angle identity above it.
float arcSine(float x)
{
    bool isWide = x > 0.5;
    float s = isWide ? sqrt(0.5 - 0.5 * x) : x;
    float t = s * s;
    float angle = s + s * t * (0.166666724 + t * (0.0749885507 + t * (0.0450013801 + t * (0.0265545422 + t * 0.0380850236))));
    return isWide ? kHalfPi - 2.0 * angle : angle;
}

// Between unit vectors, by their chord or by that to the other's opposite, whichever is shorter: radians, 0..pi.
float angleBetween(vec3 a, vec3 b)
{
    vec3 chord = a - b, rest = a + b;
    float chord2 = dot(chord, chord);
    return chord2 < 2.0 ? 2.0 * arcSine(0.5 * sqrt(chord2)) : 2.0 * (kHalfPi - arcSine(min(0.5 * length(rest), 1.0)));
}

#endif
