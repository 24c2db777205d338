// Points in the unit square, spread evenly however many, another turn of them for every pixel and light.
#ifndef LIB_POINT_SEQUENCE_GLSL
#define LIB_POINT_SEQUENCE_GLSL

// PCG in three dimensions (Jarzynski and Olano 2020).
float hashed(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v += v.yzx * v.zxy;
    v ^= v >> 16u;
    v += v.yzx * v.zxy;
    return float((v.x ^ v.y ^ v.z) >> 8u) / 16777216.0;
}

// The turn of the points' sequence for a pixel and light.
vec2 pointShift(ivec2 pixel, uint light)
{
    uvec3 seed = uvec3(uvec2(pixel), 2u * light);
    return vec2(hashed(seed), hashed(seed + uvec3(0u, 0u, 1u)));
}

// The R2 sequence (Roberts 2018).
vec2 pointOfSequence(vec2 shift, uint i) { return fract(shift + vec2(uvec2(i) * uvec2(3242174889u, 2447445414u)) * 2.3283064365386963e-10); }

#endif
