#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/occlusion.h"
#include "lib/surface.glsl"

// Cross-bilateral filter of the occluded irradiance alone (Xu et al. 2022, section 4): neighbours on the same plane count. The outermost
// taps count half, so that a width of 4k + 1 sees each of the 4 x 4 rotations equally often.
layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { OcclusionFilter pc; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 extent = imageSize(storageImages[pc.filtered]);
    if (any(greaterThanEqual(pixel, extent)))
        return;
    ivec2 lastFull = textureSize(sampledImages[pc.depth], 0) - 1;
    ivec2 full = min(ivec2((vec2(pixel) + 0.5) * pc.pixelScale), lastFull);
    vec4 centre = texelFetch(sampledImages[pc.occluded], pixel, 0);
    float depth = texelFetch(sampledImages[pc.depth], full, 0).x;
    if (depth == 0.0) {
        imageStore(storageImages[pc.filtered], pixel, centre);
        return;
    }
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], full, 0).zw);
    PixelPlane plane = pixelPlane(frameBlock, vec2(full) + 0.5, depth, normal);
    float near = frameBlock.near;

    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int dy = -pc.radius; dy <= pc.radius; ++dy)
        for (int dx = -pc.radius; dx <= pc.radius; ++dx) {
            ivec2 there = pixel + ivec2(dx, dy);
            if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, extent)))
                continue;
            ivec2 fullThere = min(ivec2((vec2(there) + 0.5) * pc.pixelScale), lastFull);
            float depthThere = texelFetch(sampledImages[pc.depth], fullThere, 0).x;
            if (depthThere == 0.0)
                continue;
            vec3 normalThere = unitFromOctahedral(texelFetch(sampledImages[pc.normals], fullThere, 0).zw);
            float weight = samePlane(plane, vec2(fullThere - full), near / depthThere) * sameFacing(plane, normalThere);
            weight *= (abs(dx) == pc.radius ? 0.5 : 1.0) * (abs(dy) == pc.radius ? 0.5 : 1.0);
            sum += weight * texelFetch(sampledImages[pc.occluded], there, 0).rgb;
            weights += weight;
        }
    // The centre itself always counts, so the sum of weights is positive.
    imageStore(storageImages[pc.filtered], pixel, vec4(sum / weights, centre.a));
}
