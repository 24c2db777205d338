// Whole parts of floats as integers. CPU devices convert a lane at a time, as conversions saturate; behind 1.5 * 2^23 the bits count by ones.
#ifndef LIB_WHOLE_GLSL
#define LIB_WHOLE_GLSL

// For -2^22 <= x < 2^22, rounded down; some integer beyond.
ivec2 wholeOf(vec2 x) { return floatBitsToInt(floor(x) + 12582912.0) - 0x4b400000; }
ivec3 wholeOf(vec3 x) { return floatBitsToInt(floor(x) + 12582912.0) - 0x4b400000; }

#endif
