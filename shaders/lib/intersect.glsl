// Rays against spheres. Directions are unit vectors.
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

#endif
