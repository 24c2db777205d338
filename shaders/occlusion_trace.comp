// Environment light that moving objects hide, by conical ray culling (Xu et al. 2022, eq. 3-5; methods/conical-culling.md).
// Variants: CULLING is kCullNone, kCullDirection, kCullLength or kCullBones; REFERENCE jitters the points anew each frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/frame.glsl"
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
#include "lib/traced.glsl"

layout(buffer_reference, scalar) readonly buffer Samples { uint word[]; };
layout(buffer_reference, scalar) readonly buffer Masks { uint word[]; };
layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(set = 0, binding = 3, scalar) readonly buffer EvenSamples { uint word[]; } evenSamples[];
layout(set = 0, binding = 3, scalar) readonly buffer Blockers { BlockerBlock block[]; } blockers[];
layout(set = 0, binding = 3, scalar) readonly buffer Capsules { CapsuleBlock block[]; } capsules[];
layout(push_constant, scalar) uniform Push { OcclusionTrace pc; };

// One thread a pixel, for finding the rays that survive; then the group's rays are dealt out evenly, so that no lane idles.
layout(local_size_x = 16, local_size_y = 8) in;
const uint kGroupSize = 128u;

struct Receiver
{
    vec3 origin;
    vec3 normal;
    mat3 frame; // of the samples
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

// `i` may differ from thread to thread.
vec3 localSample(uint i)
{
#ifdef REFERENCE
    // Another ring offset every frame: van der Corput, so that any number of frames is well spread.
    return cosineHammersley(i, pc.sampleCount, radicalInverse2(pc.frameIndex + 1u));
#else
    return sampleFromWord(Samples(pc.samples).word[i]);
#endif
}

// `i` is the same for all threads, which read it once.
vec3 evenSample(uint i)
{
#ifdef REFERENCE
    return localSample(i);
#else
    return sampleFromWord(evenSamples[pc.evenSamples].word[i]);
#endif
}

// What a cone can hide at most is a share of the unshadowed irradiance; 0.3 bounds the light's unevenness (methods/conical-culling.md).
bool isNegligible(Cone cone, vec3 normal) { return 0.3 * greatestShare(cone, normal) < pc.tolerance; }

#if CULLING == 0

void traceAll(Receiver r)
{
    for (uint i = 0u; i < pc.sampleCount; ++i) {
        vec3 direction = r.frame * evenSample(i);
        if (dynamicHitsFirstOfAll(pc.scene, r.origin, direction))
            addHidden(direction);
    }
    raysTraced = pc.sampleCount;
}

#else

// The samples base..base + 127 that may hit something that moves, and how far their rays must go.
struct Survivors
{
    uvec4 samples;
    float far;
};

uint wordCount(uint base) { return min(4u, (pc.sampleCount - base) / 32u); }

#if CULLING == 1 || CULLING == 2

uint samplesInCone(uint base, vec3 axis, float cosine)
{
    uint inside = 0u;
    uint end = base + min(32u, pc.sampleCount - base);
    for (uint i = base; i < end; ++i)
        inside |= dot(evenSample(i), axis) >= cosine ? 1u << (i - base) : 0u;
    return inside;
}

Survivors survivorsAmong(Receiver r, uint base)
{
    // Rays may end at the greatest height of all cones that hold them; the greatest of all cones is never less.
    Survivors survivors = Survivors(uvec4(0u), 0.0);
    for (uint k = 0u; k < pc.blockerCount; ++k) {
        BlockerBlock blocker = blockers[pc.blockers].block[k];
        if (isBehind(r.origin, r.normal, blocker.centre, blocker.radius))
            continue;
        Cone cone = coneOfSphere(r.origin, r.normal, blocker.centre, blocker.radius);
        vec3 axis = cone.axis * r.frame; // into the sample frame
        uint words = wordCount(base);
        for (uint w = 0u; w < words; ++w)
            survivors.samples[w] |= samplesInCone(base + 32u * w, axis, cone.all ? -2.0 : cone.cosine);
        survivors.far = max(survivors.far, CULLING == 2 ? cone.height : kRayFar);
        coneCount += base == 0u ? 1u : 0u;
    }
    return survivors;
}

#else

uvec4 maskOf(vec3 axis, float sine, uint base)
{
    uint first = (maskCell(axis, sine) * pc.sampleCount + base) / 32u, words = wordCount(base);
    uvec4 samples = uvec4(0u);
    for (uint w = 0u; w < words; ++w)
        samples[w] = Masks(pc.masks).word[first + w];
    return samples;
}

// Candidates that meet the capsule; its ends relative to the origin, in the sample frame.
uvec4 samplesThatHit(uvec4 candidates, uint base, vec3 a, vec3 b, float radius)
{
    // The test stands behind the body: CPU devices run a body once more than its loop goes round.
    uvec4 hits = uvec4(0u);
    do {
        uint w = candidates.x != 0u ? 0u : candidates.y != 0u ? 1u : candidates.z != 0u ? 2u : 3u;
        uint word = candidates[w];
        uint bit = word & (~word + 1u); // none: 0
        candidates[w] = word ^ bit;
        if (hitsCapsule(vec3(0.0), localSample(base + 32u * w + uint(max(findLSB(word), 0))), a, b, radius))
            hits[w] |= bit;
    } while (any(notEqual(candidates, uvec4(0u))));
    return hits;
}

// The samples in the cone of the sphere about the capsule: coarse, cheap, and left to samplesThatHit to refine.
uvec4 capsuleCandidates(Receiver r, CapsuleBlock capsule, vec3 toMiddle, uint base)
{
    float inverse = inversesqrt(max(dot(toMiddle, toMiddle), 1.0e-20));
    float sine = capsule.reach * inverse;
    uvec4 inCone = maskOf(toMiddle * inverse * r.frame, min(sine, 1.0), base);
    return sine < 0.99999 ? inCone : uvec4(0xffffffffu);
}

void addCapsule(Receiver r, CapsuleBlock capsule, uvec4 among, uint base, inout Survivors survivors)
{
    vec3 toMiddle = 0.5 * (capsule.a + capsule.b) - r.origin;
    if (dot(toMiddle, r.normal) <= -capsule.reach)
        return;
    coneCount += base == 0u ? 1u : 0u;
    uvec4 candidates = capsuleCandidates(r, capsule, toMiddle, base) & among & ~survivors.samples;
    vec3 a = (capsule.a - r.origin) * r.frame, b = (capsule.b - r.origin) * r.frame;
    survivors.samples |= samplesThatHit(candidates, base, a, b, capsule.radius);
}

Survivors survivorsAmong(Receiver r, uint base)
{
    Survivors survivors = Survivors(uvec4(0u), 0.0);
    uvec4 existing = mix(uvec4(0u), uvec4(0xffffffffu), greaterThan(uvec4(pc.sampleCount - base), uvec4(0u, 32u, 64u, 96u)));
    for (uint k = 0u; k < pc.blockerCount; ++k) {
        BlockerBlock blocker = blockers[pc.blockers].block[k];
        if (isBehind(r.origin, r.normal, blocker.centre, blocker.radius))
            continue;
        Cone cone = coneOfSphere(r.origin, r.normal, blocker.centre, blocker.radius);
        if (isNegligible(cone, r.normal))
            continue;
        uvec4 among = cone.all ? existing : maskOf(cone.axis * r.frame, sin(cone.halfAngle), base);
        if (all(equal(among, uvec4(0u))))
            continue;
        survivors.far = max(survivors.far, cone.height);
        for (uint c = 0u; c < blocker.capsuleCount; ++c)
            addCapsule(r, capsules[pc.capsules].block[blocker.firstCapsule + c], among, base, survivors);
    }
    return survivors;
}

#endif

// The group's rays, each the number of its pixel and of its sample, and what every pixel's rays start from.
const uint kListSize = 4096u;
shared uint rayCount;
shared uint rays[kListSize];
shared uvec4 hits[kGroupSize];
shared vec3 origins[kGroupSize];
shared vec3 tangents[kGroupSize];
shared vec3 normals[kGroupSize];
shared float fars[kGroupSize];

uint groupSum(uint value)
{
    barrier();
    rayCount = 0u;
    barrier();
    atomicAdd(rayCount, value);
    barrier();
    return rayCount;
}

uint bitCountOf(uvec4 words)
{
    uvec4 counts = uvec4(bitCount(words));
    return counts.x + counts.y + counts.z + counts.w;
}

// Traces the group's surviving rays, at most kListSize, and adds what this pixel's rays found.
void traceTogether(Receiver r, uvec4 survivors, uint base)
{
    uint me = gl_LocalInvocationIndex;
    barrier();
    rayCount = 0u;
    hits[me] = uvec4(0u);
    barrier();
    uint next = atomicAdd(rayCount, bitCountOf(survivors));
    uint words = wordCount(base);
    for (uint w = 0u; w < words; ++w)
        for (uint word = survivors[w]; word != 0u; word &= word - 1u)
            rays[next++] = me << 7u | w << 5u | uint(findLSB(word));
    barrier();
    for (uint i = me; i < rayCount; i += kGroupSize) {
        uint pixel = rays[i] >> 7u, bit = rays[i] & 127u;
        vec3 direction = mat3(tangents[pixel], cross(normals[pixel], tangents[pixel]), normals[pixel]) * localSample(base + bit);
        if (dynamicHitsFirst(pc.scene, origins[pixel], direction, fars[pixel]))
            atomicOr(hits[pixel][bit >> 5u], 1u << (bit & 31u));
    }
    barrier();
    for (uint w = 0u; w < words; ++w)
        for (uint word = hits[me][w]; word != 0u; word &= word - 1u)
            addHidden(r.frame * localSample(base + 32u * w + uint(findLSB(word))));
}

void traceSurvivors(Receiver r, bool isSurface)
{
    uint me = gl_LocalInvocationIndex;
    origins[me] = r.origin;
    tangents[me] = r.frame[0];
    normals[me] = r.normal;
    for (uint base = 0u; base < pc.sampleCount; base += 128u) {
        Survivors survivors = Survivors(uvec4(0u), 0.0);
        if (isSurface)
            survivors = survivorsAmong(r, base);
        uint mine = bitCountOf(survivors.samples);
        raysTraced += mine;
        fars[me] = survivors.far;
        uint all = groupSum(mine);
        // All rays in one round where they fit the list; a word of every pixel always does.
        uint rounds = all == 0u ? 0u : all <= kListSize ? 1u : 4u;
        for (uint round = 0u; round < rounds; ++round) {
            bvec4 isTurn = equal(uvec4(0u, 1u, 2u, 3u), uvec4(round));
            traceTogether(r, rounds == 1u ? survivors.samples : mix(uvec4(0u), survivors.samples, isTurn), base);
        }
    }
}

#endif

vec3 hiddenIrradiance()
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 9; ++i)
        sum += frameBlock.radianceSh[i] * hidden[i];
    return sum * (kPi / float(pc.sampleCount));
}

void count()
{
    uint considered = subgroupAdd(raysConsidered), traced = subgroupAdd(raysTraced), cones = subgroupAdd(coneCount);
    if (subgroupElect() && considered > 0u) {
        atomicAdd(Counters(pc.counters).block.raysConsidered, considered);
        atomicAdd(Counters(pc.counters).block.raysTraced, traced);
        atomicAdd(Counters(pc.counters).block.cones, cones);
    }
}

Receiver receiverAt(uvec2 pixel, uvec2 fullPixel, float depth)
{
    vec4 octahedral = texelFetch(sampledImages[pc.normals], ivec2(fullPixel), 0);
    vec3 position = worldPosition(frameBlock, vec2(fullPixel) + 0.5, depth);
    float rotation = pixelRotation(pixel);
#ifdef REFERENCE
    rotation += kTau * fract(float(pc.frameIndex) * 0.61803398875);
#endif
    vec3 normal = unitFromOctahedral(octahedral.zw);
    return Receiver(rayOrigin(position, unitFromOctahedral(octahedral.xy), frameBlock.eye), normal, turnedFrame(normal, rotation));
}

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uvec2 fullExtent = uvec2(textureSize(sampledImages[pc.depth], 0));
    uvec2 extent = uvec2(ceil(vec2(fullExtent) / pc.pixelScale));
    uvec2 fullPixel = min(uvec2((vec2(pixel) + 0.5) * pc.pixelScale), fullExtent - 1u);
    bool isInside = all(lessThan(pixel, extent));
    float depth = isInside ? texelFetch(sampledImages[pc.depth], ivec2(fullPixel), 0).x : 0.0;
    bool isSurface = depth > 0.0;

    for (int i = 0; i < 9; ++i)
        hidden[i] = 0.0;
    Receiver r = Receiver(vec3(0.0), vec3(0.0, 1.0, 0.0), mat3(1.0));
    if (isSurface) {
        r = receiverAt(pixel, fullPixel, depth);
        raysConsidered = pc.sampleCount;
    }
#if CULLING == 0
    if (isSurface)
        traceAll(r);
#else
    traceSurvivors(r, isSurface); // all of the group, for its barriers
#endif
#ifdef REFERENCE
    if (isInside)
        imageStore(storageImages[pc.occluded], ivec2(pixel), vec4(hiddenIrradiance(), 0.0));
#else
    float depthView = isSurface ? frameBlock.near / depth : 0.0;
    TracedPixel traced = TracedPixel(hiddenIrradiance(), float(coneCount), depthView, octahedralFromUnit(r.normal));
    if (isInside)
        imageStore(storageWordImages[pc.occluded], ivec2(pixel), packTraced(traced));
#endif
    count();
}
