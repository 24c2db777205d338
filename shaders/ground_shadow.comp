// The shadow that a character casts on the ground below it, as light that this ground does not send up: baked light knows nothing of it.
// A group a character, a thread a point of the ground. Variant COMPUTE_BVH traces without ray queries.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/occlusion.h"
#include "lib/surface.glsl"
#include "lib/hemisphere.glsl"
#ifdef COMPUTE_BVH
#include "lib/bvh.glsl"
#else
#include "lib/ray_query.glsl"
#endif
#define LOCAL_LIGHT
#include "lib/hidden_light.glsl"
#include "lib/ground.glsl"

layout(buffer_reference, scalar) readonly buffer Blockers { BlockerBlock block[]; };
layout(buffer_reference, scalar) writeonly buffer WrittenGrounds { GroundBlock block[]; };
layout(push_constant, scalar) uniform Push { GroundDispatch pc; };

const uint kPoints = kGroundRings * kGroundRingPoints;
layout(local_size_x = kPoints) in;

const uint kRays = 16u; // a point
const float kGoldenRatio = 0.61803398875;
const vec3 kUp = vec3(0.0, 1.0, 0.0);

shared vec3 missed[kPoints];

// A ring's points are spread evenly over its area.
vec2 pointOfRing(uint ring, uint i, float sphereRadius, float height)
{
    float outer = innermostRing(sphereRadius, height) * pow(3.0, float(ring)), inner = ring > 0u ? outer / 3.0 : 0.0;
    float radius = sqrt(mix(inner * inner, outer * outer, (float(i) + 0.5) / float(kGroundRingPoints)));
    float turn = kTau * fract(float(i) * kGoldenRatio);
    return radius * vec2(cos(turn), sin(turn));
}

// How far below the point the ground is; negative where there is none.
float distanceToGround(vec3 point) { return distanceToBlocker(pc.scene, kMaskStatic, point, -kUp, kRayFar, false); }

// Radiance that the ground at that point does not send up.
vec3 missedAt(vec3 point, uint thread)
{
    vec3 origin = rayOrigin(point, kUp, frameBlock.eye);
    mat3 frame = turnedFrame(kUp, kTau * fract(float(thread) * kGoldenRatio));
    beginHidden();
    for (uint i = 0u; i < kRays; ++i) {
        vec3 local = cosineHammersley(i, kRays, 0.5), direction = frame * local;
        if (dynamicHitFirst(pc.scene, origin, direction, kRayFar, -1.0) >= 0.0)
            addHidden(direction, local.z);
    }
    vec3 above, below;
    irradianceAboveAndBelow(frameBlock.baked, point, above, below);
    // Of light that comes to it, diffuse ground sends up the same share, whatever it is.
    vec3 albedo = clamp(below / max(above, vec3(1.0e-6)), vec3(0.0), vec3(1.0));
    return albedo * max(hiddenIrradiance(frameBlock, point, kRays), vec3(0.0)) / kPi;
}

vec3 meanOfRing(uint ring)
{
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kGroundRingPoints; ++i)
        sum += missed[ring * kGroundRingPoints + i];
    return sum / float(kGroundRingPoints);
}

void main()
{
    uint thread = gl_LocalInvocationIndex, ring = thread / kGroundRingPoints;
    BlockerBlock blocker = Blockers(pc.blockers).block[gl_WorkGroupID.x];
    float height = distanceToGround(blocker.centre);
    vec2 aside = pointOfRing(ring, thread % kGroundRingPoints, blocker.radius, height);
    vec3 above = blocker.centre + vec3(aside.x, 0.0, aside.y);
    float below = distanceToGround(above);
    // Steps and slopes count as the ground, what lies at another level does not.
    bool isGround = height >= 0.0 && below >= 0.0 && abs(below - height) < 0.25 * max(blocker.radius, height);
    missed[thread] = isGround ? missedAt(above - below * kUp, thread) : vec3(0.0);
    barrier();
    if (thread < kGroundRings)
        WrittenGrounds(pc.grounds).block[gl_WorkGroupID.x].missed[thread] = meanOfRing(thread);
    if (thread == 0u) {
        WrittenGrounds(pc.grounds).block[gl_WorkGroupID.x].centre = blocker.centre - max(height, 0.0) * kUp;
        WrittenGrounds(pc.grounds).block[gl_WorkGroupID.x].radius = blocker.radius;
        WrittenGrounds(pc.grounds).block[gl_WorkGroupID.x].height = max(height, 0.0);
    }
}
