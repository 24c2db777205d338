// A G-buffer pixel as a surface that area lights shine on. Variant GLOSSY: it reflects by GGX too. Needs lib/bindless.glsl, shared/frame.h.
#ifndef LIB_LIT_SURFACE_GLSL
#define LIB_LIT_SURFACE_GLSL

#include "lib/hemisphere.glsl"
#include "lib/lit_extent.glsl"
#include "lib/surface.glsl"

struct LitSurface
{
    vec3 position; // moved off the surface past its errors
    vec3 normal; // shading
    vec3 toEye; // unit
    mat3 tangentSpace; // from the world: across, on the side of the eye; beside; normal
    vec3 f0; // colour of the mirror reflection, seen head on
    float roughness;
    float diffuse; // share of the light that is reflected diffusely, before albedo
};

// Slots of the G-buffer; albedo and material are the variant's.
struct SurfaceImages
{
    uint normals, albedo, material;
};

// `depth` is reversed and more than 0.
LitSurface litSurface(FrameBlock frame, SurfaceImages images, ivec2 pixel, float depth)
{
    vec4 octahedral = texelFetch(sampledImages[images.normals], pixel, 0);
    vec3 position = worldPosition(frame, vec2(pixel) + 0.5, depth);
    vec3 normal = unitFromOctahedral(octahedral.zw);
    vec3 toEye = normalize(frame.eye - position);
    vec3 origin = rayOrigin(position, unitFromOctahedral(octahedral.xy), frame.eye);
    vec3 across = toEye - normal * dot(normal, toEye);
    across = dot(across, across) > 1.0e-8 ? normalize(across) : tangentFrame(normal)[0];
    mat3 tangentSpace = transpose(mat3(across, cross(normal, across), normal));
#ifdef GLOSSY
    vec4 material = texelFetch(sampledImages[images.material], pixel, 0); // roughness, metallic, specular
    vec3 albedo = texelFetch(sampledImages[images.albedo], pixel, 0).rgb;
    return LitSurface(origin, normal, toEye, tangentSpace, mix(vec3(0.04 * material.z), albedo, material.y), material.x, 1.0 - material.y);
#else
    return LitSurface(origin, normal, toEye, tangentSpace, vec3(0.0), 1.0, 1.0);
#endif
}

#endif
