// Stochastic light of area lights, whole and past what hides it, for the ratio of the two (Heitz, Hill, McGuire 2018). Variants: GLOSSY
// reflects by GGX too; COMPUTE_BVH traces without ray queries.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/light_share.h"
#include "shared/occlusion.h"
#include "lib/light_points.glsl"
#include "lib/lit_surface.glsl"
#include "lib/penumbra.glsl"
#include "lib/spread.glsl"
#ifdef GLOSSY
#include "lib/ggx.glsl"
#endif
#ifdef COMPUTE_BVH
#include "lib/bvh.glsl"
#else
#include "lib/ray_query.glsl"
#endif
#include "lib/light_samples.glsl"

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) writeonly buffer Samples { RatioSample value[]; };
layout(push_constant, scalar) uniform Push { RatioTrace pc; };

layout(local_size_x = kAreaGroupWidth, local_size_y = kAreaGroupHeight) in;

RatioSample sampled(BodyArrays arrays, BodyBlock body, LitSurface s, vec2 shift)
{
    RatioSample sum = RatioSample(vec2(0.0), vec2(0.0), kNoPenumbra);
    vec3 toCentre = body.centre - s.position;
    float area = litArea(arrays, body, s.position), away = length(toCentre);
    float radius = apparentRadius(arrays, body, s.position, toCentre / max(away, 1.0e-10));
    for (uint i = 0u; i < pc.rays && area > 0.0; ++i) {
        LightSample point = lightSample(arrays, body, s, area, pointOfSequence(shift, i));
        vec2 light = vec2(point.diffuse, dot(point.specular, vec3(1.0 / 3.0)));
        float blocker = -1.0;
        if (point.diffuse > 0.0)
            blocker = distanceToBlocker(pc.scene, kMaskAll, s.position, point.direction, point.before, true);
        sum.whole += light;
        sum.seen += blocker < 0.0 ? light : vec2(0.0);
        if (blocker >= 0.0)
            sum.halfPenumbra = min(sum.halfPenumbra, halfPenumbra(radius, away, blocker));
    }
    return sum;
}

void main()
{
    ivec2 litPixel = ivec2(spreadInvocation(kAreaGroupHeight)), extent = textureSize(sampledImages[pc.depth], 0);
    ivec2 lit = litExtent(extent, pc.pixelScale), pixel = litAt(litPixel, pc.pixelScale, extent);
    if (any(greaterThanEqual(litPixel, lit)))
        return;
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    if (depth <= 0.0)
        return;
    AreaBlock area = Areas(pc.area).block;
    LitSurface s = litSurface(frameBlock, SurfaceImages(pc.normals, pc.albedo, pc.material), pixel, depth);
    for (uint i = pc.firstLight; i < pc.endLight; ++i) {
        BodyBlock body = Bodies(area.arrays.bodies).body[Lights(area.lights).block[i].body];
        uint at = (i - pc.firstLight) * uint(lit.x * lit.y) + uint(litPixel.y * lit.x + litPixel.x);
        Samples(pc.samples).value[at] = sampled(area.arrays, body, s, pointShift(pixel, i));
    }
}
