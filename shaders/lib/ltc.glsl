// The GGX reflection as a linearly transformed cosine (Heitz et al. 2016), looked up in the tables of engine/bake/ltc.h.
#ifndef LIB_LTC_GLSL
#define LIB_LTC_GLSL

struct LtcLobe
{
    mat3 toCosine; // M^-1: (across, beside, normal) to the space where the lobe is the clamped cosine
    vec2 amplitude; // of a mirror colour f0 the lobe reflects f0 x + (1 - f0) y
};

LtcLobe ltcLobe(uint matrixImage, uint amplitudeImage, float roughness, float cosView)
{
    vec2 size = vec2(textureSize(sampledImages[matrixImage], 0));
    vec2 uv = (vec2(roughness, sqrt(clamp(1.0 - cosView, 0.0, 1.0))) * (size - 1.0) + 0.5) / size;
    vec4 m = textureLod(sampler2D(sampledImages[matrixImage], samplers[kLinearClamp]), uv, 0.0);
    vec2 amplitude = textureLod(sampler2D(sampledImages[amplitudeImage], samplers[kLinearClamp]), uv, 0.0).xy;
    return LtcLobe(mat3(vec3(m.x, 0.0, m.y), vec3(0.0, 1.0, 0.0), vec3(m.z, 0.0, m.w)), amplitude);
}

#endif
