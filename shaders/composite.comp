#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/frame.glsl"
#include "shared/composite.h"
#include "lib/compose.glsl"
#include "lib/octahedral.glsl"

// First term minus occluded irradiance, times albedo over pi (Xu et al. 2022, eq. 2 and 3). Where nothing is, sky.frag
// draws the environment.
// Variant EXPLAINS: the views that are not the final picture.
layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { Composite pc; };

const float kInversePi = 0.3183098861837907;

vec3 occludedAt(uint slot, ivec2 pixel) { return slot == kNoOcclusion ? vec3(0.0) : texelFetch(sampledImages[slot], pixel, 0).rgb; }

#ifdef EXPLAINS
// Blue, green, yellow, red over 0..1.
vec3 heat(float t)
{
    t = clamp(t, 0.0, 1.0);
    return clamp(vec3(2.0 * t - 0.5, 1.5 - abs(3.0 * t - 1.5), 1.0 - 2.0 * t), 0.0, 1.0);
}

vec3 viewed(ivec2 pixel, vec3 albedo, vec3 firstTerm, vec3 occluded, vec3 final)
{
    vec3 truth = pc.reference == kNoOcclusion ? final : albedo * kInversePi * shadowedIrradiance(firstTerm, occludedAt(pc.reference, pixel));
    switch (pc.view) {
    case kViewUnshadowed: return albedo * kInversePi * max(firstTerm, vec3(0.0));
    case kViewOccluded: return max(occluded, vec3(0.0)) * kInversePi;
    case kViewDifference: return 8.0 * abs(final - truth);
    case kViewCones: return pc.occluded == kNoOcclusion ? vec3(0.0) : heat(texelFetch(sampledImages[pc.occluded], pixel, 0).a / 40.0);
    case kViewNormals: return 0.5 + 0.5 * unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    case kViewReference: return truth;
    default: return final;
    }
}

#endif

void countBroken(vec3 firstTerm, vec3 occluded)
{
    vec3 both = firstTerm - occluded;
    bool nan = any(isnan(both)), inf = !nan && any(isinf(both));
    bool negative = !nan && any(lessThan(firstTerm, vec3(0.0))), clamped = !nan && isClamped(firstTerm, occluded);
    if (!subgroupAny(nan || inf || negative || clamped))
        return;
    uvec4 bits = uvec4(subgroupBallotBitCount(subgroupBallot(nan)), subgroupBallotBitCount(subgroupBallot(inf)),
                       subgroupBallotBitCount(subgroupBallot(negative)), subgroupBallotBitCount(subgroupBallot(clamped)));
    if (subgroupElect()) {
        atomicAdd(Counters(pc.counters).block.nanPixels, bits.x);
        atomicAdd(Counters(pc.counters).block.infPixels, bits.y);
        atomicAdd(Counters(pc.counters).block.negativePixels, bits.z);
        atomicAdd(Counters(pc.counters).block.clampedPixels, bits.w);
    }
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(storageImages[pc.color]))))
        return;
    if (texelFetch(sampledImages[pc.depth], pixel, 0).x == 0.0) {
        imageStore(storageImages[pc.color], pixel, vec4(0.0));
        if (pc.hasIrradiance != 0u)
            imageStore(storageImages[pc.irradiance], pixel, vec4(0.0));
        return;
    }
    vec3 albedo = texelFetch(sampledImages[pc.albedo], pixel, 0).rgb;
    vec3 firstTerm = texelFetch(sampledImages[pc.unshadowed], pixel, 0).rgb;
    vec3 occluded = occludedAt(pc.occluded, pixel);
    countBroken(firstTerm, occluded);
    vec3 irradiance = shadowedIrradiance(firstTerm, occluded);
    vec3 final = albedo * kInversePi * irradiance;
    vec3 shown = final;
#ifdef EXPLAINS
    if (uint(pixel.x) >= pc.splitX)
        shown = viewed(pixel, albedo, firstTerm, occluded, final);
#endif
    imageStore(storageImages[pc.color], pixel, vec4(shown, 1.0));
    if (pc.hasIrradiance != 0u)
        imageStore(storageImages[pc.irradiance], pixel, vec4(irradiance, 1.0));
}
