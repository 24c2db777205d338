// The irradiance of a place on the atlas. Texels lie in a buffer, because CPU devices take longer to sample an image of halves than to
// gather four texels. Needs shared/frame.h.
#ifndef LIB_ATLAS_GLSL
#define LIB_ATLAS_GLSL

#include "lib/float21.glsl"

layout(buffer_reference, scalar) readonly buffer Texels { uvec2 texel[]; };

// In texels, from the middle of the first.
vec2 placeOnAtlas(BakedLight baked, vec2 bakeUv) { return bakeUv * vec2(baked.lastTexel + 1) - 0.5; }

// Bilinear, W/m^2. No chart reaches the page's rim, so that whole texels lie about every place on one; places elsewhere, as quads at the
// rim of a triangle have them, find something.
vec3 atlasIrradiance(BakedLight baked, vec2 place)
{
    uint width = uint(baked.lastTexel.x) + 1u, last = width * uint(baked.lastTexel.y) - 2u;
    uvec2 low = uvec2(max(ivec2(place), 0));
    uint first = min(low.y * width + low.x, last);
    vec2 part = fract(place);
    Texels texels = Texels(baked.texels);
    uvec2 lowLow = texels.texel[first], lowHigh = texels.texel[first + 1u];
    uvec2 highLow = texels.texel[first + width], highHigh = texels.texel[first + width + 1u];
    return mix(mix(unpackFloats21(lowLow), unpackFloats21(lowHigh), part.x),
               mix(unpackFloats21(highLow), unpackFloats21(highHigh), part.x), part.y);
}

#endif
