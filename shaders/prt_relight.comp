#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "lib/float21.glsl"
#include "lib/half.glsl"
#include "shared/prt.h"

// The irradiance of every texel of the atlas: its transfer vector times the environment's light (Xu et al. 2022, eq. 6).
layout(local_size_x = 64) in; // a thread two texels side by side, a word of every plane

layout(buffer_reference, scalar) readonly buffer Words { uint word[]; };
layout(buffer_reference, scalar) writeonly buffer TexelPairs { uvec4 pair[]; };
layout(push_constant, scalar) uniform Push { PrtRelight pc; };

void main()
{
    uvec2 place = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(place, pc.wordCount)))
        return;
    uint pair = place.y * pc.wordCount.x + place.x, planeWords = pc.wordCount.x * pc.wordCount.y, word = pair;
    vec3 left = vec3(0.0), right = vec3(0.0);
    for (uint i = 0u; i < pc.coefficientCount; ++i) {
        vec3 radiance = frameBlock.radianceSh[i];
        for (int c = 0; c < 3; ++c, word += planeWords) {
            vec2 transfers = unpackHalf2x16(Words(pc.transfers).word[word]);
            left[c] += radiance[c] * transfers.x;
            right[c] += radiance[c] * transfers.y;
        }
    }
    TexelPairs(pc.texels).pair[pair] = uvec4(packFloats21(withinHalf(left)), packFloats21(withinHalf(right)));
}
