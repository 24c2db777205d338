#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/occlusion.h"
#include "lib/surface.glsl"
#include "lib/traced.glsl"

// Joint-bilateral upsampling (Kopf et al. 2007) from traced pixels to those of the G-buffer: of the four around, those on the pixel's own
// surface count; where none is, the twelve about them are asked, then the likest is taken. Contact shadows stay where surfaces meet.
layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { OcclusionUpsample pc; };

// The four inner ones first, then the ring about them: steps of -1..2, two bits each, in two words instead of an array in memory.
ivec2 stepOf(uint k) { return ivec2(uvec2(0xcc99f099u, 0xf0f099a5u) >> 2u * k & 3u) - 1; }

const float kEnough = 0.05;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(storageImages[pc.occluded]))))
        return;
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    PixelPlane plane = pixelPlane(frameBlock, vec2(pixel) + 0.5, frameBlock.near / max(depth, 1.0e-20), normal);
    ivec2 last = textureSize(sampledWordImages[pc.coarse], 0) - 1;
    // A traced pixel stands where it was traced: in the middle of its square of pixels.
    float middle = floor(0.5 * pc.pixelScale);
    vec2 at = (vec2(pixel) - middle) / pc.pixelScale;
    ivec2 corner = ivec2(floor(at));

    vec4 sum = vec4(0.0), best = vec4(0.0);
    float weights = 0.0, bestLikeness = -1.0;
    uint taps = depth > 0.0 ? 16u : 0u;
    for (uint k = 0u; k < taps && (k < 4u || weights < kEnough); ++k) {
        ivec2 coarse = clamp(corner + stepOf(k), ivec2(0), last);
        TracedPixel there = unpackTraced(texelFetch(sampledWordImages[pc.coarse], coarse, 0));
        float like = likeness(plane, vec2(coarse) * pc.pixelScale + middle - vec2(pixel), there);
        vec2 near = max(1.0 - abs(at - vec2(coarse)), vec2(0.0));
        float weight = like * (k < 4u ? near.x * near.y : 0.1);
        vec4 value = vec4(there.occluded, there.cones);
        sum += weight * value;
        weights += weight;
        best = like > bestLikeness ? value : best;
        bestLikeness = max(bestLikeness, like);
    }
    vec4 occluded = weights > 1.0e-3 ? sum / weights : best;
    imageStore(storageImages[pc.occluded], pixel, occluded);
}
