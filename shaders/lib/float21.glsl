// Three floats in two words, 21 bits each: sign, exponent and twelve bits behind the point, within 0.013 %. Halves would take as much room
// and cost CPU devices more to unpack. The lowest bit of the second word is free.
#ifndef LIB_FLOAT21_GLSL
#define LIB_FLOAT21_GLSL

const uint kUpper21 = 0xfffff800u;

// Finite values below 1e38; rounds to the nearest.
uvec2 packFloats21(vec3 value)
{
    uvec3 bits = floatBitsToUint(value) + 0x400u & kUpper21;
    return uvec2(bits.r | bits.b >> 21u, bits.g | bits.b >> 10u & 0x7feu);
}

vec3 unpackFloats21(uvec2 words)
{
    return uintBitsToFloat(uvec3(words.x & kUpper21, words.y & kUpper21, words.x << 21u | (words.y & 0x7feu) << 10u));
}

#endif
