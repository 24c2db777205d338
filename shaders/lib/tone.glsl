// From scene radiance to display values.
#ifndef LIB_TONE_GLSL
#define LIB_TONE_GLSL

// Khronos PBR Neutral: keeps base colours, compresses highlights towards white. Linear in, linear 0..1 out.
vec3 toneMapped(vec3 color)
{
    const float start = 0.8 - 0.04, desaturation = 0.15;
    float least = min(color.r, min(color.g, color.b));
    float offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
    color -= offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start)
        return max(color, vec3(0.0));
    float d = 1.0 - start;
    float compressed = 1.0 - d * d / (peak + d - start);
    color *= compressed / peak;
    float g = 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0);
    return mix(color, vec3(compressed), g);
}

// IEC 61966-2-1.
vec3 srgbEncoded(vec3 linear)
{
    vec3 low = 12.92 * linear, high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

#endif
