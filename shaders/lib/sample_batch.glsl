// Which samples a bound may hold, many at once. Needs lib/cone.glsl.
#ifndef LIB_SAMPLE_BATCH_GLSL
#define LIB_SAMPLE_BATCH_GLSL

// Samples are looked at by the 32, a bit each: a test against a cone is some multiplications then, unrolled, and no look-up.
const uint kBatch = 32u;
vec3 batch[kBatch];

// `axis` in the sample frame.
uint samplesInCone(Cone cone, vec3 axis)
{
    float cosine = cone.all ? -2.0 : cone.cosine;
    uint inside = 0u;
    for (uint i = 0u; i < kBatch; ++i)
        inside |= dot(batch[i], axis) >= cosine ? 1u << i : 0u;
    return inside;
}

uint samplesMeeting(CapsuleBound bound)
{
    uint meeting = 0u;
    for (uint i = 0u; i < kBatch; ++i)
        meeting |= mayMeet(bound, batch[i]) ? 1u << i : 0u;
    return meeting;
}

#endif
