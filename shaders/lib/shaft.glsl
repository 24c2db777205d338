// Whether a sphere can stand between two others.
#ifndef LIB_SHAFT_GLSL
#define LIB_SHAFT_GLSL

// The sphere at c meets the convex hull of those at a and b. On the axis at share t the hull is at least as wide as a + (b - a) t, and the
// sphere's distance to that is least where its derivative is zero.
bool meetsShaft(vec3 a, float aRadius, vec3 b, float bRadius, vec3 c, float radius)
{
    vec3 axis = b - a, to = c - a;
    float length2 = dot(axis, axis), growth = bRadius - aRadius;
    if (length2 <= growth * growth) // one holds the other
        return distance(c, growth > 0.0 ? b : a) <= max(aRadius, bRadius) + radius;
    float foot = dot(to, axis) / length2;
    float off = sqrt(max(dot(to, to) - foot * foot * length2, 0.0));
    float share = clamp(foot + growth * off / sqrt(length2 * (length2 - growth * growth)), 0.0, 1.0);
    float gap = distance(to, axis * share) - (aRadius + growth * share) - radius;
    return gap <= 1.0e-5 * (sqrt(length2) + aRadius + bRadius); // rounding
}

#endif
