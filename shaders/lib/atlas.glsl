// The irradiance of a place on the atlas. Texels lie in a buffer, because CPU devices take longer to sample an image of halves than to
// gather four texels. Needs shared/frame.h.
#ifndef LIB_ATLAS_GLSL
#define LIB_ATLAS_GLSL

#include "lib/float21.glsl"
#include "lib/whole.glsl"

// Both words at once: CPU devices gather as fast as one.
layout(buffer_reference, scalar) readonly buffer Texels { uint64_t texel[]; };

vec3 texelAt(Texels texels, uint i) { return unpackFloats21(unpackUint2x32(texels.texel[i])); }

// In texels, from the middle of the first.
vec2 placeOnAtlas(BakedLight baked, vec2 bakeUv) { return bakeUv * vec2(baked.lastTexel + 1) - 0.5; }

// Bilinear, W/m^2. No chart reaches the page's rim, so that whole texels lie about every place on one; places elsewhere, as helper
// invocations have them, find some texel of the page.
vec3 atlasIrradiance(BakedLight baked, vec2 place)
{
    uint width = uint(baked.lastTexel.x) + 1u, last = width * uint(baked.lastTexel.y) - 2u;
    ivec2 low = wholeOf(place);
    uint first = min(uint(low.y) * width + uint(low.x), last);
    vec2 part = place - vec2(low), rest = 1.0 - part;
    Texels texels = Texels(baked.texels);
    return rest.x * rest.y * texelAt(texels, first) + part.x * rest.y * texelAt(texels, first + 1u) +
           rest.x * part.y * texelAt(texels, first + width) + part.x * part.y * texelAt(texels, first + width + 1u);
}

#endif
