// A traced pixel and the surface it belongs to in one texel of four words: CPU devices pay for every fetch.
#ifndef LIB_TRACED_GLSL
#define LIB_TRACED_GLSL

struct TracedPixel
{
    vec3 occluded; // share of the unshadowed irradiance: it changes less over a curved surface than the irradiance does
    uint cones; // 0..1023
    float blockerDistance; // metres to the nearest surface that hides light; kNoBlocker: nothing does
    float depthView; // metres; 0: no surface
    vec2 normal; // shading, octahedral
};

const float kNoBlocker = 256.0;

// Six bits, quarters of an octave from 2^-7.75 m on.
uint packedDistance(float metres) { return uint(int(clamp(4.0 * log2(max(metres, 1.0e-6)) + 31.0, 0.0, 63.0))); }
float unpackedDistance(uint bits) { return exp2((float(int(bits)) - 31.0) * 0.25); }

uvec4 packTraced(TracedPixel t)
{
    uint rest = min(t.cones, 1023u) << 6u | packedDistance(t.blockerDistance);
    return uvec4(packHalf2x16(t.occluded.rg), packHalf2x16(vec2(t.occluded.b, 0.0)) | rest << 16u, floatBitsToUint(t.depthView),
                 packSnorm2x16(t.normal));
}

TracedPixel unpackTraced(uvec4 words)
{
    uint rest = words.y >> 16u;
    return TracedPixel(vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y & 0xffffu).x), rest >> 6u, unpackedDistance(rest & 63u),
                       uintBitsToFloat(words.z), unpackSnorm2x16(words.w));
}

#endif
