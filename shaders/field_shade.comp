// Which share of each area light is seen past all signed distance fields (Ban, Balint, Valasek 2020). Variant METHOD: kFieldQuilez,
// kFieldAaltonen, kFieldCone1, kFieldSubCones or kFieldTraced.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/frame.glsl"
#include "shared/area.h"
#include "shared/composite.h"
#include "lib/field.glsl"
#include "lib/field_cone.glsl"
#include "lib/field_baseline.glsl"
#include "lib/surface.glsl"
#include "lib/spread.glsl"
#ifndef METHOD
#define METHOD 3
#endif

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Bodies { BodyBlock body[]; };
layout(buffer_reference, scalar) writeonly buffer Seen { float share[]; };
layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { FieldShade pc; };

layout(local_size_x = kAreaGroupWidth, local_size_y = kAreaGroupHeight) in;

float seenOf(vec3 position, vec3 centre, float radius)
{
#if METHOD == 0
    return quilezVisibility(pc.fields, position, centre, radius);
#elif METHOD == 1
    return aaltonenVisibility(pc.fields, position, centre, radius);
#elif METHOD == 2
    return coneVisibility(pc.fields, position, centre, radius, pc.tolerance);
#else
    return subConeVisibility(pc.fields, position, centre, radius, pc.cones);
#endif
}

void main()
{
    uvec2 litPixel = spreadInvocation(kAreaGroupHeight);
    ivec2 extent = textureSize(sampledImages[pc.depth], 0);
    ivec2 pixel = min(ivec2(litPixel) * pc.pixelScale + pc.pixelScale / 2, extent - 1);
    bool isInside = litPixel.x < pc.litWidth && litPixel.y < pc.litHeight;
    float depth = isInside ? texelFetch(sampledImages[pc.depth], pixel, 0).x : 0.0;
    AreaBlock area = Areas(pc.area).block;
    vec3 position = worldPosition(frameBlock, vec2(pixel) + 0.5, max(depth, 1.0e-9));
    vec4 octahedral = texelFetch(sampledImages[pc.normals], pixel, 0);
    vec3 shading = unitFromOctahedral(octahedral.zw);
    // Off the surface by half the pixel's width too: cones would creep along what they start on.
    vec3 normal = unitFromOctahedral(octahedral.xy);
    float width = length(frameBlock.rayX) * frameBlock.near / max(depth, 1.0e-9);
    vec3 origin = rayOrigin(position, normal, frameBlock.eye) + 0.5 * width * normal;
    for (uint i = 0u; i < area.lightCount; ++i) {
        BodyBlock light = Bodies(area.arrays.bodies).body[Lights(area.lights).block[i].body];
        // What faces away from all of the light is not lit whatever stands between.
        bool isFacing = depth > 0.0 && dot(shading, light.centre - origin) > -light.radius;
        float seen = isFacing ? seenOf(origin, light.centre, light.radius) : 0.0;
        if (isInside)
            Seen(pc.seen).share[(i * pc.litHeight + litPixel.y) * pc.litWidth + litPixel.x] = seen;
    }
    uint evaluations = subgroupAdd(depth > 0.0 ? fieldEvaluations : 0u);
    if (subgroupElect())
        atomicAdd(Counters(pc.counters).block.fieldEvaluations, evaluations);
}
