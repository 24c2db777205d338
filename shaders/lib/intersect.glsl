// Rays against spheres and capsules. Directions are unit vectors.
#ifndef LIB_INTERSECT_GLSL
#define LIB_INTERSECT_GLSL

bool hitsSphere(vec3 origin, vec3 direction, vec3 centre, float radius)
{
    vec3 to = centre - origin;
    float along = dot(to, direction);
    vec3 off = to - along * direction;
    float c = dot(to, to) - radius * radius;
    return c <= 0.0 || (along > 0.0 && dot(off, off) <= radius * radius);
}

// The ray from outside or inside comes within `radius` of the segment a-b: nearest points of ray and segment (Ericson 2005, 5.1.9).
bool hitsCapsule(vec3 origin, vec3 direction, vec3 a, vec3 b, float radius)
{
    vec3 d = b - a;
    vec3 r = a - origin;
    float e = dot(d, d);
    float f = dot(direction, d);
    float c = dot(direction, r);
    float g = dot(d, r);
    float denominator = e - f * f; // direction is unit
    float t = denominator > 1.0e-7 * e ? clamp((f * c - g) / denominator, 0.0, 1.0) : 0.0;
    float s = max(0.0, c + t * f);
    t = clamp((s * f - g) / max(e, 1.0e-20), 0.0, 1.0);
    s = max(0.0, c + t * f);
    vec3 gap = r + t * d - s * direction;
    return dot(gap, gap) <= radius * radius;
}

#endif
