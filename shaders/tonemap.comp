#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/composite.h"
#include "lib/tone.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { Tonemap pc; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(storageImages[pc.picture]))))
        return;
    vec3 color = texelFetch(sampledImages[pc.color], pixel, 0).rgb * pc.exposure;
    imageStore(storageImages[pc.picture], pixel, vec4(srgbEncoded(toneMapped(color)), 1.0));
}
