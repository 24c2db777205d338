// Rays that survived at a group's pixels, dealt out evenly to its threads, so that no lane idles. Part of occlusion_trace.comp: needs its push
// constants, localSample, Receiver and Survivors.
#ifndef LIB_DEALT_RAYS_GLSL
#define LIB_DEALT_RAYS_GLSL

// The group's rays, each the number of its pixel and of its sample, and what every pixel's rays start from.
uint firstSample; // of the batch
shared uint rayCount;
shared uint rays[kGroupSize * kBatch];
shared uint hits[kGroupSize];
shared vec3 origins[kGroupSize];
shared vec3 tangents[kGroupSize];
shared vec3 normals[kGroupSize];
shared float fars[kGroupSize];
shared uint nearestHits[kGroupSize]; // bits of distances, which order as they do

uint rayPixel(uint i) { return rays[i] / kBatch; }

vec3 rayDirection(uint i)
{
    uint pixel = rayPixel(i);
    return mat3(tangents[pixel], cross(normals[pixel], tangents[pixel]), normals[pixel]) * localSample(firstSample + rays[i] % kBatch);
}

#ifdef FIELDS
#include "lib/field_pool.glsl"
FieldRay pooledRay(uint i) { return fieldRay(origins[rayPixel(i)], rayDirection(i)); }
void addPooledGroups(FieldsBlock fields, uint i, inout FieldRay ray) { addGroups(pc.scene, fields, fars[rayPixel(i)], ray); }
const uint kRaysAtOnce = kPoolRays;
#else
const uint kRaysAtOnce = kGroupSize * kBatch;
float pooledHit(uint first, uint i) { return -1.0; }
#endif

// Rays [first, end) of the group.
void traceRays(uint first, uint end)
{
#ifdef FIELDS
    traceThroughFields(Fields(pc.fields).block, first, end);
#endif
    for (uint i = first + gl_LocalInvocationIndex; i < end; i += kGroupSize) {
        uint pixel = rayPixel(i);
        float hit = dynamicHitFirst(pc.scene, origins[pixel], rayDirection(i), fars[pixel], pooledHit(first, i));
        if (hit >= 0.0) {
            atomicOr(hits[pixel], 1u << rays[i] % kBatch);
            atomicMin(nearestHits[pixel], floatBitsToUint(hit));
        }
    }
}

// Traces the group's surviving rays and adds what this pixel's found.
void traceTogether(Receiver r, Survivors survivors)
{
    uint me = gl_LocalInvocationIndex;
    barrier();
    rayCount = 0u;
    hits[me] = 0u;
    fars[me] = survivors.far;
    barrier();
    uint next = atomicAdd(rayCount, uint(bitCount(survivors.samples)));
    for (uint word = survivors.samples; word != 0u; word &= word - 1u)
        rays[next++] = me * kBatch + uint(findLSB(word));
    barrier();
    for (uint first = 0u; first < rayCount; first += kRaysAtOnce)
        traceRays(first, min(first + kRaysAtOnce, rayCount));
    barrier();
    for (uint word = hits[me]; word != 0u; word &= word - 1u) {
        vec3 local = localSample(firstSample + uint(findLSB(word)));
        addHidden(r.frame * local, local.z);
    }
}

#endif
