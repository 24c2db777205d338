// Environment light that moving objects hide, by conical ray culling (Xu et al. 2022, eq. 3-5; methods/conical-culling.md).
// Variants: CULLING is kCullNone, kCullDirection, kCullLength or kCullBones; REFERENCE jitters the points anew each frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shared/frame.h"
#include "shared/skinning.h"
#include "shared/occlusion.h"
#include "shared/composite.h"
#include "lib/surface.glsl"
#include "lib/hemisphere.glsl"
#include "lib/sh.glsl"
#include "lib/cone.glsl"
#include "lib/intersect.glsl"
#include "lib/mask_table.glsl"
#include "lib/ray_query.glsl"

layout(buffer_reference, scalar) readonly buffer Frame { FrameBlock block; };
layout(buffer_reference, scalar) readonly buffer Samples { vec4 direction[]; };
layout(buffer_reference, scalar) readonly buffer Masks { uvec4 samples[]; };
layout(buffer_reference, scalar) readonly buffer Blockers { BlockerBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Capsules { CapsuleBlock block[]; };
layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { OcclusionTrace pc; };

// A subgroup takes pixels four apart: they share a rotation, so their rays stay together. Each row of the group is one rotation.
layout(local_size_x = 8, local_size_y = 16) in;
const uvec2 kGroupPixels = uvec2(16, 8);

struct Receiver
{
    vec3 origin;
    vec3 normal;
    mat3 frame; // of the samples
    float unshadowed; // luminance of the unshadowed irradiance, for the tolerance
};

// What the samples found: sums of the SH basis over hidden directions, from which the irradiance follows once.
float hidden[9];
uint raysConsidered = 0u, raysTraced = 0u, coneCount = 0u;

void addHidden(vec3 direction)
{
    float y[9];
    shBasis3(direction, y);
    for (int i = 0; i < 9; ++i)
        hidden[i] += y[i];
}

vec3 localSample(uint i)
{
#ifdef REFERENCE
    // Another ring offset every frame: van der Corput, so that any number of frames is well spread.
    return cosineHammersley(i, pc.sampleCount, radicalInverse2(pc.frameIndex * 2u + 1u));
#else
    return Samples(pc.samples).direction[i].xyz;
#endif
}

// What a cone can hide at most is a share of the unshadowed irradiance; 0.3 bounds the light's unevenness (methods/conical-culling.md).
bool isNegligible(Cone cone, vec3 normal) { return 0.3 * greatestShare(cone, normal) < pc.tolerance; }

#if CULLING == 0

void traceAll(Receiver r)
{
    for (uint i = 0u; i < pc.sampleCount; ++i) {
        vec3 direction = r.frame * localSample(i);
        if (dynamicHitsFirstOfAll(pc.scene, r.origin, direction))
            addHidden(direction);
    }
    raysTraced = pc.sampleCount;
}

#else

void traceSurvivors(Receiver r, uint base, uint survivors, float far)
{
    raysTraced += bitCount(survivors);
    while (survivors != 0u) {
        uint i = base + uint(findLSB(survivors));
        survivors &= survivors - 1u;
        vec3 direction = r.frame * localSample(i);
        if (dynamicHitsFirst(pc.scene, r.origin, direction, far))
            addHidden(direction);
    }
}

#if CULLING == 1 || CULLING == 2

void traceCulled(Receiver r)
{
    // Rays may end at the greatest height of all cones that hold them; the greatest of all cones is never less.
    float far = 0.0;
    for (uint base = 0u; base < pc.sampleCount; base += 32u) {
        uint survivors = 0u;
        uint count = min(32u, pc.sampleCount - base);
        for (uint k = 0u; k < pc.blockerCount; ++k) {
            BlockerBlock blocker = Blockers(pc.blockers).block[k];
            if (isBehind(r.origin, r.normal, blocker.centre, blocker.radius))
                continue;
            Cone cone = coneOfSphere(r.origin, r.normal, blocker.centre, blocker.radius);
            vec3 axis = cone.axis * r.frame; // into the sample frame
            for (uint i = 0u; i < count; ++i)
                survivors |= cone.all || dot(localSample(base + i), axis) >= cone.cosine ? 1u << i : 0u;
            far = max(far, cone.height);
            coneCount += base == 0u ? 1u : 0u;
        }
        traceSurvivors(r, base, survivors, CULLING == 2 ? far : kRayFar);
    }
}

#else

// Candidates of one word that meet the capsule; ends relative to the origin, in the sample frame.
uint samplesThatHit(uint candidates, uint base, vec3 a, vec3 b, float radius)
{
    uint hits = 0u;
    while (candidates != 0u) {
        uint bit = candidates & (~candidates + 1u);
        candidates ^= bit;
        vec3 direction = localSample(base + uint(findLSB(bit)));
        if (hitsCapsule(vec3(0.0), direction, a, b, radius))
            hits |= bit;
    }
    return hits;
}

void addCapsule(Receiver r, CapsuleBlock capsule, uint base, inout uvec4 survivors, inout float far)
{
    float above = max(dot(capsule.a - r.origin, r.normal), dot(capsule.b - r.origin, r.normal));
    if (above <= -capsule.radius)
        return;
    Cone cone = coneOfCapsule(r.origin, r.normal, capsule.a, capsule.b, capsule.radius);
    far = max(far, cone.height);
    coneCount += base == 0u ? 1u : 0u;
    uint cell = maskCell(cone.axis * r.frame, cone.halfAngle);
    uvec4 candidates = cone.all ? uvec4(0xffffffffu) : Masks(pc.masks).samples[cell * ((pc.sampleCount + 127u) / 128u) + base / 128u];
    candidates &= ~survivors;
    vec3 a = (capsule.a - r.origin) * r.frame, b = (capsule.b - r.origin) * r.frame;
    uint words = min(4u, (pc.sampleCount - base) / 32u);
    for (uint w = 0u; w < words; ++w)
        survivors[w] |= samplesThatHit(candidates[w], base + 32u * w, a, b, capsule.radius);
}

void traceBones(Receiver r)
{
    float far = 0.0;
    for (uint base = 0u; base < pc.sampleCount; base += 128u) {
        uvec4 survivors = uvec4(0u);
        for (uint k = 0u; k < pc.blockerCount; ++k) {
            BlockerBlock blocker = Blockers(pc.blockers).block[k];
            if (isBehind(r.origin, r.normal, blocker.centre, blocker.radius))
                continue;
            if (isNegligible(coneOfSphere(r.origin, r.normal, blocker.centre, blocker.radius), r.normal))
                continue;
            for (uint c = 0u; c < blocker.capsuleCount; ++c)
                addCapsule(r, Capsules(pc.capsules).block[blocker.firstCapsule + c], base, survivors, far);
        }
        uint words = min(4u, (pc.sampleCount - base) / 32u);
        for (uint w = 0u; w < words; ++w)
            traceSurvivors(r, base + 32u * w, survivors[w], far);
    }
}

#endif
#endif

vec3 occludedIrradiance(Receiver r)
{
    for (int i = 0; i < 9; ++i)
        hidden[i] = 0.0;
#if CULLING == 0
    traceAll(r);
#elif CULLING == 3
    traceBones(r);
#else
    traceCulled(r);
#endif
    raysConsidered = pc.sampleCount;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 9; ++i)
        sum += Frame(pc.frame).block.radianceSh[i] * hidden[i];
    return sum * (kPi / float(pc.sampleCount));
}

void count()
{
    uint considered = subgroupAdd(raysConsidered), traced = subgroupAdd(raysTraced), cones = subgroupAdd(coneCount);
    if (subgroupElect()) {
        atomicAdd(Counters(pc.counters).block.raysConsidered, considered);
        atomicAdd(Counters(pc.counters).block.raysTraced, traced);
        atomicAdd(Counters(pc.counters).block.cones, cones);
    }
}

void main()
{
    uvec2 lane = uvec2(gl_LocalInvocationID.x % 4u, gl_LocalInvocationID.x / 4u);
    uvec2 offset = uvec2(gl_LocalInvocationID.y % 4u, gl_LocalInvocationID.y / 4u);
    uvec2 pixel = gl_WorkGroupID.xy * kGroupPixels + lane * kRotationPattern + offset;
    uvec2 extent = uvec2(imageSize(storageImages[pc.occluded]));
    if (any(greaterThanEqual(pixel, extent)))
        return;

    uvec2 fullExtent = uvec2(textureSize(sampledImages[pc.depth], 0));
    uvec2 fullPixel = min(uvec2((vec2(pixel) + 0.5) * pc.pixelScale), fullExtent - 1u);
    float depth = texelFetch(sampledImages[pc.depth], ivec2(fullPixel), 0).x;
    if (depth == 0.0) {
        imageStore(storageImages[pc.occluded], ivec2(pixel), vec4(0.0));
        return;
    }
    Frame frame = Frame(pc.frame);
    vec4 normals = texelFetch(sampledImages[pc.normals], ivec2(fullPixel), 0);
    vec3 position = worldPosition(frame.block, vec2(fullPixel) + 0.5, depth);

    Receiver r;
    r.normal = unitFromOctahedral(normals.zw);
    r.origin = rayOrigin(position, unitFromOctahedral(normals.xy), frame.block.eye);
    float rotation = pixelRotation(pixel);
#ifdef REFERENCE
    rotation += kTau * fract(float(pc.frameIndex) * 0.61803398875);
#endif
    r.frame = turnedFrame(r.normal, rotation);
    imageStore(storageImages[pc.occluded], ivec2(pixel), vec4(occludedIrradiance(r), float(coneCount)));
    count();
}
