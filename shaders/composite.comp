#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/frame.glsl"
#include "shared/composite.h"
#include "lib/compose.glsl"
#include "lib/tone.glsl"
#include "lib/traced.glsl"
#include "lib/upsample.glsl"

// First term minus occluded irradiance, times albedo over pi (Xu et al. 2022, eq. 2 and 3), and on to display values, all in registers:
// CPU devices pay for every image that is read or written in between. Where nothing is, sky.frag draws the environment.
// Variants: OCCLUDED takes traced pixels away from the first term; AREA_LIT adds the light of area lights, AREA_GLOSSY what of it is reflected
// by GGX, AREA_UPSAMPLED where it was found for a pixel of every square; DARK is black where nothing is; EXPLAINS keeps what lies behind the
// picture, and shows it.
layout(local_size_x = kComposeGroupWidth) in; // a thread a block of pixels

layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { Composite pc; };

const float kInversePi = 0.3183098861837907;

uvec4 broken = uvec4(0u); // pixels of the thread's: NaN, infinite, negative, clamped

void noteBroken(vec3 firstTerm, vec3 occluded)
{
    vec3 both = firstTerm - occluded;
    bool nan = any(isnan(both)), inf = !nan && any(isinf(both));
    broken += uvec4(nan, inf, !nan && any(lessThan(firstTerm, vec3(0.0))), !nan && isClamped(firstTerm, occluded));
}

void countBroken()
{
    if (!subgroupAny(broken != uvec4(0u)))
        return;
    uvec4 sum = subgroupAdd(broken);
    if (subgroupElect()) {
        atomicAdd(Counters(pc.counters).block.nanPixels, sum.x);
        atomicAdd(Counters(pc.counters).block.infPixels, sum.y);
        atomicAdd(Counters(pc.counters).block.negativePixels, sum.z);
        atomicAdd(Counters(pc.counters).block.clampedPixels, sum.w);
    }
}

Found foundAt(ivec2 place)
{
#ifdef OCCLUDED
    TracedPixel traced = unpackTraced(texelFetch(sampledWordImages[pc.traced], place, 0));
    Found found = nothingFound();
    found.depthView = traced.depthView;
    found.normal = traced.normal;
    found.hidden = traced.hidden;
    found.occluded = vec4(coloured(lackedBy(traced.normal, traced.hidden), traced.tint), float(int(traced.cones)));
#else
    Found found = surfaceFound(frameBlock, pc.depth, pc.normals, place, pc.pixelScale);
#endif
#ifdef AREA_UPSAMPLED
    found.diffuse = texelFetch(sampledImages[pc.areaDiffuse], place, 0).rgb;
#ifdef AREA_GLOSSY
    found.specular = texelFetch(sampledImages[pc.areaSpecular], place, 0).rgb;
#endif
#endif
    return found;
}

#ifdef EXPLAINS

// Blue, green, yellow, red over 0..1.
vec3 heat(float t)
{
    t = clamp(t, 0.0, 1.0);
    return clamp(vec3(2.0 * t - 0.5, 1.5 - abs(3.0 * t - 1.5), 1.0 - 2.0 * t), 0.0, 1.0);
}

vec3 viewed(vec3 final, vec3 albedo, vec3 firstTerm, vec4 occluded, vec3 truth, vec3 normal)
{
    vec3 reference = albedo * kInversePi * shadowedIrradiance(firstTerm, truth);
    switch (pc.view) {
    case kViewUnshadowed: return albedo * kInversePi * max(firstTerm, vec3(0.0));
    case kViewOccluded: return max(occluded.rgb, vec3(0.0)) * kInversePi;
    case kViewDifference: return 8.0 * abs(final - reference);
    case kViewCones: return heat(occluded.a / 40.0);
    case kViewNormals: return 0.5 + 0.5 * normal;
    case kViewReference: return reference;
    default: return final;
    }
}

void keep(uint slot, ivec2 pixel, vec4 value)
{
    if (slot != kAbsent)
        imageStore(storageImages[slot], pixel, value);
}

#endif

Found foundFor(PixelBlock block, ivec2 pixel, float depthView, vec3 normal, bool asksRing, out bool isEnough)
{
    isEnough = true;
    Found found = nothingFound();
#if defined(OCCLUDED) || defined(AREA_UPSAMPLED)
    found = upsampled(block, pixel, pixelPlane(frameBlock, vec2(pixel) + 0.5, depthView, normal), asksRing, isEnough);
#endif
#if defined(AREA_LIT) && !defined(AREA_UPSAMPLED)
    found.diffuse = texelFetch(sampledImages[pc.areaDiffuse], pixel, 0).rgb;
#ifdef AREA_GLOSSY
    found.specular = texelFetch(sampledImages[pc.areaSpecular], pixel, 0).rgb;
#endif
#endif
    return found;
}

bool composeSurface(PixelBlock block, ivec2 pixel, float depthView, bool asksRing)
{
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    bool isEnough;
    Found found = foundFor(block, pixel, depthView, normal, asksRing, isEnough);
    if (!isEnough)
        return false;
    vec3 albedo = texelFetch(sampledImages[pc.albedo], pixel, 0).rgb;
    vec3 firstTerm = texelFetch(sampledImages[pc.unshadowed], pixel, 0).rgb;
    vec4 occluded = found.occluded;
#ifdef EXPLAINS
    vec3 truth = pc.reference != kAbsent ? texelFetch(sampledImages[pc.reference], pixel, 0).rgb : occluded.rgb;
    occluded.rgb = pc.isReferenceShown != 0u ? truth : occluded.rgb;
#endif
    noteBroken(firstTerm, occluded.rgb);
    vec3 irradiance = shadowedIrradiance(firstTerm, occluded.rgb) + found.diffuse;
    vec3 color = albedo * kInversePi * irradiance + found.specular;
#ifdef EXPLAINS
    color = uint(pixel.x) >= pc.splitX ? viewed(color, albedo, firstTerm, occluded, truth, normal) : color;
    keep(pc.color, pixel, vec4(color, 1.0));
    keep(pc.irradiance, pixel, vec4(irradiance, 1.0));
    keep(pc.occluded, pixel, occluded);
#endif
    imageStore(storageImages[pc.picture], pixel, vec4(srgbEncoded(toneMapped(color * pc.exposure)), 1.0));
    return true;
}

bool finishPixel(PixelBlock block, ivec2 pixel, bool asksRing)
{
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    if (depth > 0.0)
        return composeSurface(block, pixel, frameBlock.near / depth, asksRing);
#ifdef DARK
    imageStore(storageImages[pc.picture], pixel, vec4(0.0, 0.0, 0.0, 1.0));
#endif
#ifdef EXPLAINS
    keep(pc.color, pixel, vec4(0.0));
    keep(pc.irradiance, pixel, vec4(0.0));
    keep(pc.occluded, pixel, vec4(0.0));
#endif
    return true;
}

void main()
{
    ivec2 extent = imageSize(storageImages[pc.picture]);
    PixelBlock block = blockOf(ivec2(gl_GlobalInvocationID.xy), pc.pixelScale, extent);
    if (all(lessThan(block.first, extent)))
        finishBlock(block, extent);
    countBroken();
}
