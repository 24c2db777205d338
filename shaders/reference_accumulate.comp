#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/occlusion.h"

// Running mean over frames of what the reference traced; its share of a frame is 1 / frames.
layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { ReferenceAccumulate pc; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(storageImages[pc.now]))))
        return;
    vec4 mean = pc.frameCount > 0u ? texelFetch(sampledImages[pc.before], pixel, 0) : vec4(0.0);
    if (pc.traced != kNothingTraced)
        mean += (texelFetch(sampledImages[pc.traced], pixel, 0) - mean) / float(pc.frameCount + 1u);
    imageStore(storageImages[pc.now], pixel, mean);
}
