// Light that a surface has of points on a body, before anything stands between. Variant GLOSSY: what is reflected by GGX too. Needs
// lib/light_points.glsl, lib/lit_surface.glsl and, for the variant, lib/ggx.glsl.
#ifndef LIB_LIGHT_SAMPLES_GLSL
#define LIB_LIGHT_SAMPLES_GLSL

#include "lib/point_sequence.glsl"

struct LightSample
{
    vec3 direction; // from the surface, unit
    float before; // metres: what hides the point is met before
    float diffuse; // for a radiance of 1 and this point alone: W/m^2, cosine-weighted; 0 where neither faces the other
    vec3 specular; // W/(m^2 sr) towards the eye
};

// `area` is litArea of the body, more than 0; `u` in [0, 1).
LightSample lightSample(BodyArrays arrays, BodyBlock body, LitSurface s, float area, vec2 u)
{
    LightPoint p = pointOnLight(arrays, body, s.position, area, u);
    float distance2 = dot(p.position, p.position);
    vec3 direction = p.position * inversesqrt(max(distance2, 1.0e-20));
    float cosine = dot(direction, s.normal), cosineLight = -dot(direction, p.normal);
    float weight = cosine > 0.0 && cosineLight > 0.0 ? cosine * cosineLight * area / max(distance2, 1.0e-20) : 0.0;
    LightSample found = LightSample(direction, sqrt(distance2) * 0.9999, weight, vec3(0.0));
#ifdef GLOSSY
    if (weight > 0.0)
        found.specular = weight * ggxReflection(s.normal, s.toEye, direction, max(s.roughness * s.roughness, 1.0e-3), s.f0);
#endif
    return found;
}

#endif
