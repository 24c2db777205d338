#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "lib/frame.glsl"
#include "shared/composite.h"
#include "lib/compose.glsl"
#include "lib/surface.glsl"
#include "lib/tone.glsl"
#include "lib/traced.glsl"

// First term minus occluded irradiance, times albedo over pi (Xu et al. 2022, eq. 2 and 3), and on to display values, all in registers:
// CPU devices pay for every image that is read or written in between. Where nothing is, sky.frag draws the environment.
// Variants: OCCLUDED takes traced pixels away from the first term; AREA_LIT adds the light of area lights, AREA_GLOSSY what of it is reflected
// by GGX; DARK is black where nothing is; EXPLAINS keeps what lies behind the picture, and shows it.
layout(local_size_x = 8, local_size_y = 8) in; // a thread a block of pixels that lie between the same four traced ones

layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { Composite pc; };

const float kInversePi = 0.3183098861837907;

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

#ifdef OCCLUDED

// The four traced pixels around a block of pixels, and where they were traced from the upper left one.
TracedPixel around[4];
ivec2 places[4];

TracedPixel tracedAt(ivec2 corner, ivec2 place) { return unpackTraced(texelFetch(sampledWordImages[pc.traced], corner + place, 0)); }

// At the picture's edge the nearest stands in.
ivec2 placeOf(ivec2 corner, ivec2 place) { return clamp(corner + place, ivec2(0), pc.lastTraced) - corner; }

// The ring about the four, as steps of -1..2 of two bits each: in two words instead of an array in memory.
ivec2 ringStep(uint k) { return ivec2(uvec2(0xcc99f0u, 0xf0f099u) >> 2u * k & 3u) - 1; }

// Joint-bilateral upsampling (Kopf et al. 2007): of the four traced pixels around, those on the pixel's own surface count; where none is,
// the ring about them is asked, then the likest is taken. Contact shadows stay where surfaces meet. Occluded share; cones in a.
vec4 upsampled(ivec2 pixel, ivec2 corner, float depthView, vec3 normal)
{
    const float kEnough = 0.05;
    PixelPlane plane = pixelPlane(frameBlock, vec2(pixel) + 0.5, depthView, normal);
    float scale = float(pc.pixelScale);
    // A traced pixel stands where it was traced: in the middle of its square of pixels.
    vec2 origin = vec2(corner * pc.pixelScale + pc.pixelScale / 2 - pixel);
    vec2 at = -origin / scale;
    vec4 sum = vec4(0.0), best = vec4(0.0);
    float weights = 0.0, bestLikeness = -1.0;
    for (int k = 0; k < 4; ++k) {
        float like = likeness(plane, origin + scale * vec2(places[k]), around[k]);
        vec2 near = mix(1.0 - at, at, bvec2(k & 1, k >> 1));
        vec4 value = vec4(around[k].occluded, float(around[k].cones));
        float weight = like * near.x * near.y;
        sum += weight * value;
        weights += weight;
        best = like > bestLikeness ? value : best;
        bestLikeness = max(bestLikeness, like);
    }
    for (uint k = 0u; k < 12u && weights < kEnough; ++k) {
        ivec2 place = placeOf(corner, ringStep(k));
        TracedPixel traced = tracedAt(corner, place);
        float like = likeness(plane, origin + scale * vec2(place), traced);
        vec4 value = vec4(traced.occluded, float(traced.cones));
        sum += 0.1 * like * value;
        weights += 0.1 * like;
        best = like > bestLikeness ? value : best;
        bestLikeness = max(bestLikeness, like);
    }
    return weights > 1.0e-3 ? sum / weights : best;
}

#endif

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

void composeSurface(ivec2 pixel, ivec2 corner, float depthView)
{
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    vec3 albedo = texelFetch(sampledImages[pc.albedo], pixel, 0).rgb;
    vec3 firstTerm = texelFetch(sampledImages[pc.unshadowed], pixel, 0).rgb;
    vec4 occluded = vec4(0.0);
#ifdef OCCLUDED
    occluded = vec4(firstTerm, 1.0) * upsampled(pixel, corner, depthView, normal);
#endif
#ifdef EXPLAINS
    vec3 truth = pc.reference != kAbsent ? texelFetch(sampledImages[pc.reference], pixel, 0).rgb : occluded.rgb;
    occluded.rgb = pc.isReferenceShown != 0u ? truth : occluded.rgb;
#endif
    countBroken(firstTerm, occluded.rgb);
    vec3 irradiance = shadowedIrradiance(firstTerm, occluded.rgb);
#ifdef AREA_LIT
    irradiance += texelFetch(sampledImages[pc.areaDiffuse], pixel, 0).rgb;
#endif
    vec3 color = albedo * kInversePi * irradiance;
#ifdef AREA_GLOSSY
    color += texelFetch(sampledImages[pc.areaSpecular], pixel, 0).rgb;
#endif
#ifdef EXPLAINS
    color = uint(pixel.x) >= pc.splitX ? viewed(color, albedo, firstTerm, occluded, truth, normal) : color;
    keep(pc.color, pixel, vec4(color, 1.0));
    keep(pc.irradiance, pixel, vec4(irradiance, 1.0));
    keep(pc.occluded, pixel, occluded);
#endif
    imageStore(storageImages[pc.picture], pixel, vec4(srgbEncoded(toneMapped(color * pc.exposure)), 1.0));
}

void composePixel(ivec2 pixel, ivec2 corner)
{
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    if (depth > 0.0) {
        composeSurface(pixel, corner, frameBlock.near / depth);
        return;
    }
#ifdef DARK
    imageStore(storageImages[pc.picture], pixel, vec4(0.0, 0.0, 0.0, 1.0));
#endif
#ifdef EXPLAINS
    keep(pc.color, pixel, vec4(0.0));
    keep(pc.irradiance, pixel, vec4(0.0));
    keep(pc.occluded, pixel, vec4(0.0));
#endif
}

void main()
{
    ivec2 extent = imageSize(storageImages[pc.picture]);
    ivec2 corner = ivec2(gl_GlobalInvocationID.xy) - 1;
    ivec2 first = corner * pc.pixelScale + pc.pixelScale / 2;
    if (any(greaterThanEqual(first, extent)))
        return;
#ifdef OCCLUDED
    for (int k = 0; k < 4; ++k) {
        places[k] = placeOf(corner, ivec2(k & 1, k >> 1));
        around[k] = tracedAt(corner, places[k]);
    }
#endif
    for (int y = 0; y < pc.pixelScale; ++y)
        for (int x = 0; x < pc.pixelScale; ++x) {
            ivec2 pixel = first + ivec2(x, y);
            if (all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, extent)))
                composePixel(pixel, corner);
        }
}
