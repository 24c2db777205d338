// Light that rays found hidden from a point. Variant LOCAL_LIGHT: that of the irradiance volume instead of the environment's.
#ifndef LIB_HIDDEN_LIGHT_GLSL
#define LIB_HIDDEN_LIGHT_GLSL

#include "shared/frame.h"
#include "lib/sh.glsl"
#ifdef LOCAL_LIGHT
#include "lib/irradiance_volume.glsl"
#endif

// What the samples found: sums of the SH basis over hidden directions, from which the irradiance follows once.
#ifdef LOCAL_LIGHT
const uint kHidden = 16u;
#else
const uint kHidden = 9u;
#endif
float hidden[kHidden];

void beginHidden()
{
    for (uint i = 0u; i < kHidden; ++i)
        hidden[i] = 0.0;
}

void addHidden(vec3 direction)
{
    float y[kHidden];
#ifdef LOCAL_LIGHT
    shBasis4(direction, y);
#else
    shBasis3(direction, y);
#endif
    for (uint i = 0u; i < kHidden; ++i)
        hidden[i] += y[i];
}

// Of the light that comes to the point, by so many samples. W/m^2.
vec3 hiddenIrradiance(FrameBlock frame, vec3 position, uint sampleCount)
{
    vec3 sum = vec3(0.0);
#ifdef LOCAL_LIGHT
    vec3 radiance[kHidden];
    localRadiance(frame.baked, position, radiance);
    // A surface that hides a direction faces the receiver and sends it some of its own irradiance, which is the cosine convolution turned
    // about: a factor a band.
    for (uint i = 0u; i < kHidden; ++i) {
        float sent = i < 1u ? 1.0 : i < 4u ? -2.0 / 3.0 : i < 9u ? 0.25 : 0.0;
        sum += (1.0 - sent * frame.baked.sentOn) * radiance[i] * hidden[i];
    }
#else
    for (uint i = 0u; i < kHidden; ++i)
        sum += frame.radianceSh[i] * hidden[i];
#endif
    return sum * (kPi / float(sampleCount));
}

// Ringing leaves some surfaces without light to speak of; whatever their share is, composition clamps it.
vec3 shareOf(vec3 occluded, vec3 unshadowed)
{
    float most = max(unshadowed.r, max(unshadowed.g, unshadowed.b));
    return clamp(occluded / max(unshadowed, vec3(1.0e-3 * most + 1.0e-6)), vec3(-2.0), vec3(2.0));
}

#endif
