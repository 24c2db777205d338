// Environment light that moving objects and distance fields hide, by conical ray culling (Xu et al. 2022, eq. 3-5; methods/conical-culling.md).
// Variants: CULLING is kCullNone, kCullDirection, kCullLength or kCullBones; REFERENCE jitters the points anew each frame; COMPUTE_BVH
// traces without ray queries; LOCAL_LIGHT hides what comes in by the irradiance volume instead of the environment, and what shadowed ground
// would send up; FIELDS: distance fields hide light as what moves does, the spheres about their groups of steps for bounds.
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
#include "lib/spread.glsl"
#include "lib/cone.glsl"
#include "lib/sample_batch.glsl"
#ifdef COMPUTE_BVH
#include "lib/bvh.glsl"
#else
#include "lib/ray_query.glsl"
#endif
#include "lib/traced.glsl"
#ifdef FIELDS
#include "lib/field.glsl"
#include "lib/field_ray.glsl"
#include "lib/field_boxes.glsl"
#endif
#include "lib/hidden_light.glsl"
#ifdef LOCAL_LIGHT
#include "lib/ground.glsl"
#endif

layout(buffer_reference, scalar) readonly buffer Samples { vec3 direction[]; };
layout(buffer_reference, scalar) readonly buffer Blockers { BlockerBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Capsules { CapsuleBlock block[]; };
layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { OcclusionTrace pc; };

// One thread a pixel, for finding the rays that survive; then a thread of its group may trace any of them.
layout(local_size_x = kTraceGroupWidth, local_size_y = kTraceGroupHeight) in;
const uint kGroupSize = kTraceGroupWidth * kTraceGroupHeight;

struct Receiver
{
    vec3 origin;
    vec3 normal;
    mat3 frame; // of the samples
};

float blockerDistance = kNoBlocker;
uint raysConsidered = 0u, raysTraced = 0u, coneCount = 0u, ringingPixels = 0u;

// `i` may differ from thread to thread.
vec3 localSample(uint i)
{
#ifdef REFERENCE
    // Another ring offset every frame: van der Corput, so that any number of frames is well spread.
    return cosineHammersley(i, pc.sampleCount, radicalInverse2(pc.frameIndex + 1u));
#else
    return Samples(pc.samples).direction[i];
#endif
}

// What a cone can hide at most is a share of the unshadowed irradiance; 0.3 bounds the light's unevenness (methods/conical-culling.md).
bool isNegligible(Cone cone, vec3 normal) { return 0.3 * greatestShare(cone, normal) < pc.tolerance; }

#if CULLING == 0

// How far off a distance field is that the ray meets; negative where it meets none.
float fieldAlong(vec3 origin, vec3 direction)
{
#ifdef FIELDS
    FieldsBlock fields = Fields(pc.fields).block;
    FieldRay ray = fieldRay(origin, direction);
    addGroups(pc.scene, fields, kRayFar, ray);
    return distanceToField(fields, ray);
#else
    return -1.0;
#endif
}

void traceAll(Receiver r)
{
    for (uint i = 0u; i < pc.sampleCount; ++i) {
        vec3 local = localSample(i), direction = r.frame * local;
        float field = fieldAlong(r.origin, direction);
        float hit = dynamicHitFirstOfAll(pc.scene, r.origin, direction, field);
        if (hit >= 0.0) {
            addHidden(direction, local.z);
            // As culled rays find it, so that the filter does the same whatever was culled.
            if (pc.isFiltered != 0u)
                blockerDistance = min(blockerDistance, dynamicHitFirst(pc.scene, r.origin, direction, kRayFar, field));
        }
    }
    raysTraced = pc.sampleCount;
}

#else

void loadBatch(uint base)
{
    for (uint i = 0u; i < kBatch; ++i)
        batch[i] = localSample(base + i);
}

// The samples of a character's cone that may meet one of its capsules too.
uint samplesMeetingBones(Receiver r, BlockerBlock blocker, uint among)
{
    // A loop that goes round for nobody is what spares CPU devices the work; a single sample is sooner traced than asked about.
    bool isWorthIt = bitCount(among) > 1;
    uint capsuleCount = isWorthIt ? blocker.capsuleCount : 0u;
    uint meeting = 0u;
    for (uint c = 0u; c < capsuleCount; ++c) {
        CapsuleBlock capsule = Capsules(pc.capsules).block[blocker.firstCapsule + c];
        meeting |= samplesMeeting(
            boundOfCapsule((capsule.middle - r.origin) * r.frame, capsule.arm * r.frame, capsule.radius, capsule.reach));
    }
    coneCount += capsuleCount;
    return isWorthIt ? meeting & among : among;
}

// The samples that may hit something that moves, and how far their rays must go.
struct Survivors
{
    uint samples;
    float far;
};

// Those that may hit something in the sphere.
Survivors survivorsOfSphere(Receiver r, vec3 centre, float radius)
{
    Cone cone = coneOfSphere(r.origin, r.normal, centre, radius);
    bool matters = !isBehind(r.origin, r.normal, centre, radius);
#if CULLING == 3
    matters = matters && !isNegligible(cone, r.normal);
#endif
    coneCount += matters ? 1u : 0u;
    return Survivors(matters ? samplesInCone(cone, cone.axis * r.frame) : 0u, !matters ? 0.0 : CULLING == 1 ? kRayFar : cone.height);
}

// Rays may end at the greatest height of all cones that hold them; the greatest of all cones is never less.
Survivors together(Survivors a, Survivors b) { return Survivors(a.samples | b.samples, max(a.far, b.far)); }

Survivors survivorsOfBatch(Receiver r)
{
    Survivors survivors = Survivors(0u, 0.0);
    for (uint k = 0u; k < pc.blockerCount; ++k) {
        BlockerBlock blocker = Blockers(pc.blockers).block[k];
        Survivors among = survivorsOfSphere(r, blocker.centre, blocker.radius);
#if CULLING == 3
        among.samples = samplesMeetingBones(r, blocker, among.samples);
#endif
        survivors = together(survivors, among);
    }
#ifdef FIELDS
    FieldsBlock fields = Fields(pc.fields).block;
    for (uint g = 0u; g < fields.groupCount; ++g) {
        FieldGroupBlock group = fieldGroup(fields, g);
        survivors = together(survivors, survivorsOfSphere(r, group.centre, groupRadius(group)));
    }
#endif
    return survivors;
}

#include "lib/dealt_rays.glsl"

void traceSurvivors(Receiver r, bool isSurface)
{
    uint me = gl_LocalInvocationIndex;
    origins[me] = r.origin;
    tangents[me] = r.frame[0];
    normals[me] = r.normal;
    nearestHits[me] = floatBitsToUint(kNoBlocker);
    for (firstSample = 0u; firstSample < pc.sampleCount; firstSample += kBatch) {
        loadBatch(firstSample);
        Survivors survivors = Survivors(0u, 0.0);
        if (isSurface)
            survivors = survivorsOfBatch(r);
        raysTraced += uint(bitCount(survivors.samples));
        traceTogether(r, survivors);
    }
    blockerDistance = uintBitsToFloat(nearestHits[me]);
}

#endif

// Irradiance that the pixel lacks, W/m^2: hidden from it, or not sent up by ground that is hidden from others.
vec3 lacking(Receiver r)
{
    vec3 irradiance = hiddenIrradiance(frameBlock, r.origin, pc.sampleCount);
#ifdef LOCAL_LIGHT
    irradiance += missedFromGround(pc.grounds, pc.groundCount, r.origin, r.normal);
#endif
    return irradiance;
}

// The same without what rings, as few bands of harmonics do: nothing lacks less than nothing. More than a thousandth of the sky's light counts
// as clamped, for all pixels that the traced one stands for.
vec3 lackingAtLeastNothing(Receiver r)
{
    vec3 irradiance = lacking(r), mean = abs(frameBlock.radianceSh[0]) * (0.2820947918 * kPi);
    ringingPixels = any(lessThan(irradiance, -1.0e-3 * mean)) ? uint(pc.pixelScale * pc.pixelScale) : 0u;
    return mix(irradiance, vec3(0.0), lessThan(irradiance, vec3(0.0))); // NaN stays what it is, for whoever counts it
}

void count()
{
    uint considered = subgroupAdd(raysConsidered), traced = subgroupAdd(raysTraced), cones = subgroupAdd(coneCount);
    uint ringing = subgroupAdd(ringingPixels);
    if (subgroupElect() && ringing > 0u)
        atomicAdd(Counters(pc.counters).block.clampedPixels, ringing);
#ifdef FIELDS
    uint evaluations = subgroupAdd(fieldEvaluations);
    if (subgroupElect() && evaluations > 0u)
        atomicAdd(Counters(pc.counters).block.fieldEvaluations, evaluations);
#endif
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
    vec3 normal = unitFromOctahedral(octahedral.zw), geometricNormal = unitFromOctahedral(octahedral.xy);
#ifdef FIELDS
    // Where the camera sees a field it is up to a part of a pixel off its surface, on either side: rays begin outside.
    float halfPixel = 0.5 * length(frameBlock.rayX) * frameBlock.near / depth;
    position += max(halfPixel - abs(fieldDistance(Fields(pc.fields).block, position, halfPixel)), 0.0) * geometricNormal;
#endif
    return Receiver(rayOrigin(position, geometricNormal, frameBlock.eye), normal, turnedFrame(normal, rotation));
}

void main()
{
#ifdef FIELDS
    holdSteps(Fields(pc.fields).block);
#endif
    uvec2 pixel = spreadInvocation(kTraceGroupHeight);
    uvec2 fullExtent = uvec2(textureSize(sampledImages[pc.depth], 0));
    uvec2 extent = uvec2(ceil(vec2(fullExtent) / pc.pixelScale));
    uvec2 fullPixel = min(uvec2((vec2(pixel) + 0.5) * pc.pixelScale), fullExtent - 1u);
    bool isInside = all(lessThan(pixel, extent));
    float depth = isInside ? texelFetch(sampledImages[pc.depth], ivec2(fullPixel), 0).x : 0.0;
    bool isSurface = depth > 0.0;

    beginHidden();
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
        imageStore(storageImages[pc.occluded], ivec2(pixel), vec4(lacking(r), 0.0));
#else
    float depthView = isSurface ? frameBlock.near / depth : 0.0;
    vec3 irradiance = isSurface ? lackingAtLeastNothing(r) : vec3(0.0);
    vec3 hidden = hiddenVector(sumOf(irradiance), hiddenTowards(r.normal), r.normal);
    TracedPixel traced = TracedPixel(hidden, tintOf(irradiance), coneCount, blockerDistance, depthView, r.normal);
    if (isInside)
        imageStore(storageWordImages[pc.occluded], ivec2(pixel), packTraced(traced));
#endif
    count();
}
