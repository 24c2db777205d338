// A traced pixel and the surface it belongs to in one texel of four words: CPU devices pay for every fetch.
#ifndef LIB_TRACED_GLSL
#define LIB_TRACED_GLSL

#include "lib/half.glsl"
#include "lib/octahedral.glsl"
#include "lib/tint.glsl"

// What is hidden is kept as a vector, so that surfaces nearby that face elsewhere, as folds do, know what they lack of it.
struct TracedPixel
{
    vec3 hidden; // its product with a normal is the irradiance that such a surface lacks, the sum of all channels, W/m^2
    vec2 tint; // its, as of lib/tint.glsl
    uint cones; // 0..1023
    float blockerDistance; // metres to the nearest surface that hides light; kNoBlocker: nothing does
    float depthView; // metres; 0: no surface
    vec3 normal; // shading
};

const float kNoBlocker = 256.0;

// Along `towards`, the middle of what hides light, as far as the normal's plane allows: nobody near by shall lack three times as much.
vec3 hiddenVector(float irradiance, vec3 towards, vec3 normal)
{
    const float kLeastCosine = 0.33;
    float cosine = dot(towards, normal);
    return withinHalf(irradiance * (towards + max(kLeastCosine - cosine, 0.0) * normal) / max(cosine, kLeastCosine));
}

// NaN stays what it is, for whoever counts it.
float lackedBy(vec3 normal, vec3 hidden)
{
    float lacked = dot(normal, hidden);
    return lacked < 0.0 ? 0.0 : lacked;
}

// Six bits, quarters of an octave from 2^-7.75 m on.
uint packedDistance(float metres) { return uint(int(clamp(4.0 * log2(max(metres, 1.0e-6)) + 31.0, 0.0, 63.0))); }
float unpackedDistance(uint bits) { return exp2((float(int(bits)) - 31.0) * 0.25); }

// Whole numbers of `most` for 0..1. Adding 2^23 leaves them in a float's lowest bits: CPU devices convert a lane at a time.
uint packedShare(float share, float most) { return floatBitsToUint(clamp(share, 0.0, 1.0) * most + 8388608.0) & 0xffffu; }
float unpackedShare(uint bits, float most) { return float(int(bits)) / most; }

// Depths keep 13 significant bits, normals and tint are off by a two-thousandth at most.
uvec4 packTraced(TracedPixel t)
{
    uint rest = min(t.cones, 1023u) << 6u | packedDistance(t.blockerDistance);
    uint depth = floatBitsToUint(t.depthView) + 0x400u & 0x7ffff800u;
    vec2 normal = 0.5 + 0.5 * octahedralFromUnit(t.normal);
    return uvec4(packHalf2x16(t.hidden.xy), packHalf2x16(vec2(t.hidden.z, 0.0)) | rest << 16u,
                 depth << 1u | packedShare(normal.x, 4094.0),
                 packedShare(normal.y, 4094.0) << 20u | packedShare(t.tint.x, 1023.0) << 10u | packedShare(t.tint.y, 1023.0));
}

TracedPixel unpackTraced(uvec4 words)
{
    uint rest = words.y >> 16u;
    vec2 normal = 2.0 * vec2(unpackedShare(words.z & 0xfffu, 4094.0), unpackedShare(words.w >> 20u, 4094.0)) - 1.0;
    return TracedPixel(vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y & 0xffffu).x),
                       vec2(unpackedShare(words.w >> 10u & 0x3ffu, 1023.0), unpackedShare(words.w & 0x3ffu, 1023.0)), rest >> 6u,
                       unpackedDistance(rest & 63u), uintBitsToFloat((words.z & 0xfffff000u) >> 1u), unitFromOctahedral(normal));
}

#endif
