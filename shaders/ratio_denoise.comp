// Both terms of a ratio through the same cross-bilateral filter (an a-trous wavelet, Dammertz et al. 2010), which goes no farther than the
// penumbra is wide. What no ray was hidden from is left at exactly 1. Variant LAST writes the ratio.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/area.h"
#include "shared/light_share.h"
#include "lib/lit_extent.glsl"
#include "lib/spread.glsl"
#include "lib/surface.glsl"

layout(buffer_reference, scalar) readonly buffer Samples { RatioSample value[]; };
layout(buffer_reference, scalar) writeonly buffer Denoised { RatioSample value[]; };
layout(buffer_reference, scalar) writeonly buffer Shares { vec2 value[]; };
layout(push_constant, scalar) uniform Push { RatioDenoise pc; };

layout(local_size_x = kAreaGroupWidth, local_size_y = kAreaGroupHeight) in;

ivec2 extent, lit;

struct Neighbour
{
    uint at; // among the pixels
    float weight; // as far as it lies on the same surface
    float distance; // metres
};

Neighbour neighbour(ivec2 here, ivec2 pixel, PixelPlane plane, vec3 position, ivec2 step)
{
    ivec2 place = here + pc.spacing * step;
    bool isInside = all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, lit));
    place = isInside ? place : here;
    ivec2 there = litAt(place, pc.pixelScale, extent);
    float depth = texelFetch(sampledImages[pc.depth], there, 0).x;
    float depthView = frameBlock.near / max(depth, 1.0e-30);
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], there, 0).zw);
    float like = likeness(plane, vec2(there - pixel), depthView, normal);
    vec2 spline = mix(vec2(0.375), mix(vec2(0.25), vec2(0.0625), equal(abs(step), ivec2(2))), notEqual(step, ivec2(0)));
    return Neighbour(uint(place.y * lit.x + place.x), isInside && depth > 0.0 ? like * spline.x * spline.y : 0.0,
                     distance(frameBlock.eye + fromEye(frameBlock, vec2(there) + 0.5, depthView), position));
}

// A half at half of the penumbra's half.
float within(float halfPenumbra, float metres)
{
    float share = 2.0 * metres / max(halfPenumbra, 1.0e-6);
    return exp2(-share * share);
}

void main()
{
    ivec2 here = ivec2(spreadInvocation(kAreaGroupHeight));
    extent = textureSize(sampledImages[pc.depth], 0);
    lit = litExtent(extent, pc.pixelScale);
    ivec2 pixel = litAt(here, pc.pixelScale, extent);
    if (any(greaterThanEqual(here, lit)))
        return;
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    if (depth <= 0.0)
        return;
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    float depthView = frameBlock.near / depth;
    PixelPlane plane = pixelPlane(frameBlock, vec2(pixel) + 0.5, depthView, normal);
    vec3 position = frameBlock.eye + fromEye(frameBlock, vec2(pixel) + 0.5, depthView);
    uint pixels = uint(lit.x * lit.y), own = uint(here.y * lit.x + here.x);
    for (uint light = 0u; light < pc.lightCount; ++light) {
        RatioSample sum = RatioSample(vec2(0.0), vec2(0.0), Samples(pc.samples).value[light * pixels + own].halfPenumbra);
        float nearest = sum.halfPenumbra;
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x) {
                Neighbour n = neighbour(here, pixel, plane, position, ivec2(x, y));
                RatioSample there = Samples(pc.samples).value[light * pixels + n.at];
                float weight = n.weight * within(min(sum.halfPenumbra, there.halfPenumbra), n.distance);
                // What lies off the frame or the surface is not looked at: nothing was written there.
                sum.seen += n.weight > 0.0 ? weight * there.seen : vec2(0.0);
                sum.whole += n.weight > 0.0 ? weight * there.whole : vec2(0.0);
                nearest = weight > 0.01 ? min(nearest, there.halfPenumbra) : nearest;
            }
#ifdef LAST
        vec2 share = mix(vec2(1.0), min(sum.seen / max(sum.whole, vec2(1.0e-30)), vec2(1.0)), greaterThan(sum.whole, vec2(0.0)));
        Shares(pc.denoised).value[light * pixels + own] = share;
#else
        sum.halfPenumbra = nearest;
        Denoised(pc.denoised).value[light * pixels + own] = sum;
#endif
    }
}
