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

// The ray from outside or inside comes within `radius` of the segment a-b (after Ericson 2005, 5.1.9). Seen along the ray first, where
// the ray is a point: the usual |d|^2 |ray|^2 - (d . ray)^2 would cancel where segment and ray are nearly parallel.
bool hitsCapsule(vec3 origin, vec3 direction, vec3 a, vec3 b, float radius)
{
    vec3 d = b - a, r = a - origin;
    float dAlong = dot(d, direction), rAlong = dot(r, direction);
    vec3 dAcross = d - dAlong * direction, rAcross = r - rAlong * direction;
    float t = clamp(-dot(dAcross, rAcross) / max(dot(dAcross, dAcross), 1.0e-30), 0.0, 1.0);
    vec3 gap = rAcross + t * dAcross;
    // The nearest point of the segment is behind: of the ray it is the origin.
    if (rAlong + t * dAlong < 0.0)
        gap = r + clamp(-dot(r, d) / max(dot(d, d), 1.0e-30), 0.0, 1.0) * d;
    return dot(gap, gap) <= radius * radius;
}

#endif
