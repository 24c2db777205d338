#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/occlusion.h"
#include "lib/surface.glsl"

// Joint-bilateral upsampling (Kopf et al. 2007): of the four coarse pixels around, those on the pixel's own plane count; where none is,
// the one that is nearest to it. Contact shadows stay where the surfaces meet.
layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { OcclusionUpsample pc; };

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 fullExtent = imageSize(storageImages[pc.occluded]);
    if (any(greaterThanEqual(pixel, fullExtent)))
        return;
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    if (depth == 0.0) {
        imageStore(storageImages[pc.occluded], pixel, vec4(0.0));
        return;
    }
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    PixelPlane plane = pixelPlane(frameBlock, vec2(pixel) + 0.5, depth, normal);
    ivec2 lastCoarse = textureSize(sampledImages[pc.coarse], 0) - 1;
    // Coarse values belong to the full pixel they were traced for.
    float middle = floor(0.5 * pc.pixelScale);
    vec2 at = (vec2(pixel) - middle) / pc.pixelScale;
    ivec2 corner = ivec2(floor(at));
    vec2 share = at - vec2(corner);

    vec4 sum = vec4(0.0), best = vec4(0.0);
    float weights = 0.0, bestLikeness = -1.0;
    for (int k = 0; k < 4; ++k) {
        ivec2 step = ivec2(k & 1, k >> 1);
        ivec2 coarse = clamp(corner + step, ivec2(0), lastCoarse);
        ivec2 full = min(ivec2((vec2(coarse) + 0.5) * pc.pixelScale), fullExtent - 1);
        float depthThere = texelFetch(sampledImages[pc.depth], full, 0).x;
        if (depthThere == 0.0)
            continue;
        vec4 value = texelFetch(sampledImages[pc.coarse], coarse, 0);
        float likeness = samePlane(plane, vec2(full - pixel), frameBlock.near / depthThere);
        vec2 bilinear = mix(1.0 - share, share, vec2(step));
        float weight = likeness * bilinear.x * bilinear.y;
        sum += weight * value;
        weights += weight;
        best = likeness > bestLikeness ? value : best;
        bestLikeness = max(bestLikeness, likeness);
    }
    imageStore(storageImages[pc.occluded], pixel, weights > 1.0e-3 ? sum / weights : best);
}
