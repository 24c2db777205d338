// The GGX reflection itself, with Smith's masking correlated by height and Schlick's Fresnel (Heitz 2014, eq. 72 and 99): what the tables of
// lib/ltc.glsl stand for.
#ifndef LIB_GGX_GLSL
#define LIB_GGX_GLSL

// 1/sr, by colour. Directions are unit vectors; `alpha` is roughness squared, more than 0.
vec3 ggxReflection(vec3 normal, vec3 view, vec3 light, float alpha, vec3 f0)
{
    vec3 halfway = normalize(view + light);
    float nv = dot(normal, view), nl = dot(normal, light), nh = dot(normal, halfway), vh = max(dot(view, halfway), 0.0);
    if (nv <= 0.0 || nl <= 0.0)
        return vec3(0.0);
    float a2 = alpha * alpha;
    vec3 across = cross(normal, halfway); // 1 - nh^2 without its cancellation
    float spread = dot(across, across) + a2 * nh * nh;
    float normals = a2 / (3.14159265 * spread * spread);
    float masked = nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl);
    float grazing = 1.0 - vh;
    float grazing2 = grazing * grazing;
    return (f0 + (1.0 - f0) * (grazing2 * grazing2 * grazing)) * (normals * 0.5 / masked);
}

#endif
