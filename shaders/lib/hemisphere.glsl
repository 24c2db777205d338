// Directions over a hemisphere: tangent frames, cosine-weighted Hammersley points, and a fixed rotation per pixel.
#ifndef LIB_HEMISPHERE_GLSL
#define LIB_HEMISPHERE_GLSL

const float kPi = 3.14159265358979;
const float kTau = 6.28318530717959;

// Columns tangent, bitangent, normal, without a branch at the poles (Duff et al. 2017).
mat3 tangentFrame(vec3 n)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// The same frame turned about the normal.
mat3 turnedFrame(vec3 n, float radians)
{
    mat3 frame = tangentFrame(n);
    float c = cos(radians), s = sin(radians);
    return mat3(frame[0] * c + frame[1] * s, frame[1] * c - frame[0] * s, n);
}

float radicalInverse2(uint i) { return float(bitfieldReverse(i)) * 2.3283064365386963e-10; }

// Point i of `count`, cosine-weighted about +Z; `jitter` in [0, 1) places the point within its ring.
vec3 cosineHammersley(uint i, uint count, float jitter)
{
    float u = (float(i) + jitter) / float(count);
    float phi = kTau * radicalInverse2(i);
    float r = sqrt(u);
    return vec3(r * cos(phi), r * sin(phi), sqrt(max(0.0, 1.0 - u)));
}

// Sixteen rotations in a square of 4 x 4 pixels, dealt out in ordered-dither order so that neighbours differ most. A filter of that
// width sees each once, and pixels four apart trace the same directions, which keeps their rays together.
const uint kRotationPattern = 4u;

float pixelRotation(uvec2 pixel)
{
    uint x = pixel.x ^ pixel.y, y = pixel.y;
    uint cell = (x & 1u) << 3u | (y & 1u) << 2u | (x & 2u) | (y & 2u) >> 1u;
    return kTau * fract(float(cell) * 0.61803398875);
}

#endif
