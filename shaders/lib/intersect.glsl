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
    // Of the two lines first, seen along the ray: |d|^2 - (d . direction)^2 would cancel where they are nearly parallel.
    vec3 across = d - dot(d, direction) * direction;
    float t = clamp(-dot(across, r) / max(dot(across, across), 1.0e-30), 0.0, 1.0);
    float s = max(0.0, dot(r + t * d, direction));
    t = clamp(dot(s * direction - r, d) / max(dot(d, d), 1.0e-30), 0.0, 1.0);
    s = max(0.0, dot(r + t * d, direction));
    vec3 gap = r + t * d - s * direction;
    return dot(gap, gap) <= radius * radius;
}

#endif
