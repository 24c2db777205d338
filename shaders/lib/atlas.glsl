// The irradiance of a place on the atlas. Texels lie in a buffer, because CPU devices take longer to sample an image of halves than to
// gather four texels. Needs shared/frame.h.
#ifndef LIB_ATLAS_GLSL
#define LIB_ATLAS_GLSL

layout(buffer_reference, scalar) readonly buffer Texels { uvec2 texel[]; };

vec3 texelIrradiance(uvec2 words) { return vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x); }

// Bilinear, W/m^2.
vec3 atlasIrradiance(BakedLight baked, vec2 bakeUv)
{
    vec2 place = clamp(bakeUv * vec2(baked.lastTexel + 1) - 0.5, vec2(0.0), vec2(baked.lastTexel));
    ivec2 low = ivec2(place), high = min(low + 1, baked.lastTexel);
    vec2 part = place - vec2(low);
    int width = baked.lastTexel.x + 1;
    Texels texels = Texels(baked.texels);
    uvec2 lowLow = texels.texel[low.y * width + low.x], lowHigh = texels.texel[low.y * width + high.x];
    uvec2 highLow = texels.texel[high.y * width + low.x], highHigh = texels.texel[high.y * width + high.x];
    return mix(mix(texelIrradiance(lowLow), texelIrradiance(lowHigh), part.x),
               mix(texelIrradiance(highLow), texelIrradiance(highHigh), part.x), part.y);
}

#endif
