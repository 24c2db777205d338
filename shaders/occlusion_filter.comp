#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/occlusion.h"
#include "lib/surface.glsl"
#include "lib/traced.glsl"

// Cross-bilateral filter of what is hidden alone (Xu et al. 2022, section 4): neighbours on the same surface count, within the penumbra, by
// what they know of a surface that faces as the pixel's own does. The outermost taps count half, so that a width of 4k + 1 sees each of the
// 4 x 4 rotations equally often.
// A shadow changes over lengths such as its blocker is away: 1 well within that, a half at half of it.
float withinPenumbra(vec3 apart, float blockerDistance)
{
    float t2 = dot(apart, apart) / (0.25 * blockerDistance * blockerDistance);
    return 1.0 / (1.0 + t2 * t2);
}

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Push { OcclusionFilter pc; };

TracedPixel filtered(ivec2 pixel, TracedPixel centre, ivec2 last)
{
    vec2 full = min(floor((vec2(pixel) + 0.5) * pc.pixelScale), vec2(pc.lastPixel)) + 0.5;
    vec3 position = fromEye(frameBlock, full, centre.depthView);
    PixelPlane plane = pixelPlane(frameBlock, full, centre.depthView, centre.normal);
    // Nothing else may count.
    float weights = 1.0e-6;
    vec3 hidden = weights * centre.hidden, lacked = weights * coloured(lackedBy(centre.normal, centre.hidden), centre.tint);
    for (int dy = -pc.radius; dy <= pc.radius; ++dy)
        for (int dx = -pc.radius; dx <= pc.radius; ++dx) {
            ivec2 there = clamp(pixel + ivec2(dx, dy), ivec2(0), last);
            TracedPixel neighbour = unpackTraced(texelFetch(sampledWordImages[pc.traced], there, 0));
            vec2 offset = vec2(there - pixel) * pc.pixelScale;
            vec3 apart = fromEye(frameBlock, full + offset, neighbour.depthView) - position;
            float like = likeness(plane, offset, neighbour.depthView, neighbour.normal);
            float weight = like * withinPenumbra(apart, min(centre.blockerDistance, neighbour.blockerDistance));
            weight *= (abs(dx) == pc.radius ? 0.5 : 1.0) * (abs(dy) == pc.radius ? 0.5 : 1.0);
            hidden += weight * neighbour.hidden;
            lacked += weight * coloured(lackedBy(centre.normal, neighbour.hidden), neighbour.tint);
            weights += weight;
        }
    centre.hidden = hidden / weights;
    centre.tint = tintOf(lacked);
    return centre;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 extent = imageSize(storageWordImages[pc.filtered]);
    if (any(greaterThanEqual(pixel, extent)))
        return;
    TracedPixel centre = unpackTraced(texelFetch(sampledWordImages[pc.traced], pixel, 0));
    if (centre.depthView > 0.0)
        centre = filtered(pixel, centre, extent - 1);
    imageStore(storageWordImages[pc.filtered], pixel, packTraced(centre));
}
