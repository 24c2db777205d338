// Unit vectors on the octahedral square [-1, 1]^2 (Meyer et al. 2010).
#ifndef LIB_OCTAHEDRAL_GLSL
#define LIB_OCTAHEDRAL_GLSL

vec2 signNotZero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

vec2 octahedralFromUnit(vec3 v)
{
    vec2 p = v.xy / (abs(v.x) + abs(v.y) + abs(v.z));
    return v.z >= 0.0 ? p : (1.0 - abs(p.yx)) * signNotZero(p);
}

vec3 unitFromOctahedral(vec2 p)
{
    vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (v.z < 0.0)
        v.xy = (1.0 - abs(v.yx)) * signNotZero(v.xy);
    return normalize(v);
}

#endif
