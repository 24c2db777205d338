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
const uint kHidden = kLocalShCoefficients;
#else
const uint kHidden = 9u;
#endif
float hidden[kHidden];
vec3 hiddenSum; // of the directions, as dense as they are and not as the samples

void beginHidden()
{
    hiddenSum = vec3(0.0);
    for (uint i = 0u; i < kHidden; ++i)
        hidden[i] = 0.0;
}

// Samples are as dense as their cosines to the normal.
void addHidden(vec3 direction, float cosine)
{
    hiddenSum += direction / max(cosine, 0.1); // those that graze are few, and would drown the others
    float y[kHidden];
#ifdef LOCAL_LIGHT
    shBasis5(direction, y);
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
    // A surface that hides a direction faces the receiver and sends it some of its own irradiance, which is the convolution with the cosine
    // turned about.
    for (uint i = 0u; i < kHidden; ++i) {
        float sent = (i >= 1u && i < 4u ? -1.0 : 1.0) / kPi * cosineLobe(i);
        sum += (1.0 - sent * frame.baked.sentOn) * radiance[i] * hidden[i];
    }
#else
    for (uint i = 0u; i < kHidden; ++i)
        sum += frame.radianceSh[i] * hidden[i];
#endif
    return sum * (kPi / float(sampleCount));
}

// Unit, the middle of it; the normal where nothing is hidden.
vec3 hiddenTowards(vec3 normal)
{
    float length2 = dot(hiddenSum, hiddenSum);
    return length2 > 0.0 ? hiddenSum * inversesqrt(length2) : normal;
}

#endif
