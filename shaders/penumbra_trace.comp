// One ray a pixel and light, to the light's middle: the ray-traced shadow buffer of methods/penumbra.md. Variant COMPUTE_BVH traces without
// ray queries.
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
#ifdef COMPUTE_BVH
#include "lib/bvh.glsl"
#else
#include "lib/ray_query.glsl"
#endif

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) writeonly buffer Rays { ShadowRay ray[]; };
layout(push_constant, scalar) uniform Push { PenumbraTrace pc; };

layout(local_size_x = kAreaGroupWidth, local_size_y = kAreaGroupHeight) in;

ShadowRay shadowRay(BodyArrays arrays, BodyBlock body, LitSurface s)
{
    vec3 toCentre = body.centre - s.position;
    float away = length(toCentre);
    vec3 direction = toCentre / max(away, 1.0e-10);
    if (dot(direction, s.normal) <= 0.0)
        return ShadowRay(kFacesAway, 0.0);
    float blocker = distanceToBlocker(pc.scene, kMaskAll, s.position, direction, away * 0.9999, false);
    float radius = apparentRadius(arrays, body, s.position, direction);
    return blocker < 0.0 ? ShadowRay(kLit, 0.0) : ShadowRay(halfPenumbra(radius, away, blocker), blocker);
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
    LitSurface s = litSurface(frameBlock, SurfaceImages(pc.normals, 0u, 0u), pixel, depth);
    for (uint i = pc.firstLight; i < pc.endLight; ++i) {
        BodyBlock body = Bodies(area.arrays.bodies).body[Lights(area.lights).block[i].body];
        uint at = (i - pc.firstLight) * uint(lit.x * lit.y) + uint(litPixel.y * lit.x + litPixel.x);
        Rays(pc.rays).ray[at] = shadowRay(area.arrays, body, s);
    }
}
