// Which share of each area light is seen past all signed distance fields (Ban, Balint, Valasek 2020). Variant METHOD: kFieldQuilez,
// kFieldAaltonen, kFieldCone1, kFieldSubCones or kFieldTraced; the first three take lights for the spheres around them, and so does the fourth
// without OUTLINES. BONES: capsules stand for characters, which are seen by their meshes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/frame.glsl"
#include "shared/area.h"
#include "shared/composite.h"
#ifndef METHOD
#define METHOD 3
#endif
#ifdef OUTLINES
#define POLYGON_PLACES 6
#define POLYGON_CORNERS 36
#define SILHOUETTE_EDGES 64
#define SILHOUETTE_BODY_EDGES 64
#define FACE_WORDS 4
#define OUTLINE_CORNERS 30
#define LIGHT_VERTICES 64
#define AREA_OCCLUDERS 1
#endif
#include "lib/bodies.glsl"
#include "lib/field.glsl"
#include "lib/field_cone.glsl"
#include "lib/field_baseline.glsl"
#include "lib/lit_surface.glsl"
#include "lib/point_sequence.glsl"
#include "lib/spread.glsl"
#ifdef OUTLINES
#include "lib/area_occluders.glsl"
#include "lib/field_cells.glsl"
#include "lib/field_light.glsl"
#endif
#if METHOD == 4
#include "lib/field_ray.glsl"
#include "lib/light_points.glsl"
#include "lib/light_samples.glsl"
#endif

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) writeonly buffer Seen { float share[]; };
layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { FieldShade pc; };

layout(local_size_x = kAreaGroupWidth, local_size_y = kAreaGroupHeight) in;

#if METHOD == 4

// By points on the light, as they light a diffuse surface.
float seenOf(FieldsBlock fields, AreaBlock area, BodyBlock light, LitSurface s, vec2 shift)
{
    float squareMetres = litArea(area.arrays, light, s.position), seen = 0.0, all = 0.0;
    for (uint i = 0u; i < pc.rays && squareMetres > 0.0; ++i) {
        LightSample point = lightSample(area.arrays, light, s, squareMetres, pointOfSequence(shift, i));
        bool isSeen = point.diffuse > 0.0;
        FieldRay ray = fieldRay(s.position, point.direction);
        if (isSeen)
            addGroups(fields, point.before, ray);
        isSeen = isSeen && distanceToField(fields, ray) < 0.0;
        seen += isSeen ? point.diffuse : 0.0;
        all += point.diffuse;
    }
    return all > 0.0 ? seen / all : 1.0;
}

#else

float seenOf(FieldsBlock fields, AreaBlock area, BodyBlock light, LitSurface s, vec2 shift)
{
#if METHOD == 0
    return quilezVisibility(fields, s.position, light.centre, light.radius);
#elif METHOD == 1
    return aaltonenVisibility(fields, s.position, light.centre, light.radius);
#elif METHOD == 2
    return coneVisibility(fields, s.position, light.centre, light.radius, pc.tolerance);
#elif defined(OUTLINES)
    if ((light.flags & kBodySphere) == 0u)
        return lightVisibility(fields, area.arrays, light, s.position, s.normal, pc.cells);
    return subConeVisibility(fields, s.position, light.centre, light.radius, pc.cones);
#else
    return subConeVisibility(fields, s.position, light.centre, light.radius, pc.cones);
#endif
}

#endif

#ifdef BONES

// Skin lies in its capsule as well as outside: along the normal until it is outside, and no longer on the surface.
const uint kMostLifts = 8u; // a capsule's inside is met at right angles nearly everywhere, so that two or three do

vec3 outOfBones(FieldsBlock fields, vec3 p, vec3 normal, float clear, bool isSkin)
{
    for (uint i = 0u; i < kMostLifts && isSkin; ++i) {
        float f = fieldDistance(fields, p);
        isSkin = f < clear;
        p += isSkin ? (clear - f) * normal : vec3(0.0);
    }
    return p;
}

#endif

void main()
{
    holdSteps(pc.fields);
    ivec2 litPixel = ivec2(spreadInvocation(kAreaGroupHeight)), extent = textureSize(sampledImages[pc.depth], 0);
    ivec2 pixel = litAt(litPixel, pc.pixelScale, extent);
    bool isInside = litPixel.x < int(pc.litWidth) && litPixel.y < int(pc.litHeight);
    float depth = isInside ? texelFetch(sampledImages[pc.depth], pixel, 0).x : 0.0;
    AreaBlock area = Areas(pc.area).block;
    LitSurface s = litSurface(frameBlock, SurfaceImages(pc.normals, 0u, 0u), pixel, max(depth, 1.0e-9));
    // Off the surface by half the pixel's width too: cones would creep along what they start on.
    float width = length(frameBlock.rayX) * frameBlock.near / max(depth, 1.0e-9);
    vec3 geometric = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).xy);
    s.position += 0.5 * width * geometric;
    FieldsBlock seenFields = pc.fields;
#ifdef BONES
    bool isSkin = depth > 0.0 && texelFetch(sampledImages[pc.albedo], pixel, 0).a > 0.5;
    s.position = outOfBones(pc.fields, s.position, geometric, 0.5 * width, isSkin);
    seenFields.groupCount = pc.seenGroups;
#endif
    for (uint i = 0u; i < area.lightCount; ++i) {
        BodyBlock light = Bodies(area.arrays.bodies).body[Lights(area.lights).block[i].body];
        // What faces away from all of the light is not lit whatever stands between.
        bool isFacing = depth > 0.0 && dot(s.normal, light.centre - s.position) > -light.radius;
        bool isByBones = i >= pc.firstByBones && i < pc.endByBones;
        FieldsBlock fields = seenFields;
        fields.groupCount = isByBones ? pc.fields.groupCount : fields.groupCount;
        float seen = isFacing ? seenOf(fields, area, light, s, pointShift(pixel, i)) : 0.0;
        if (isInside)
            Seen(pc.seen).share[(uint(i) * pc.litHeight + uint(litPixel.y)) * pc.litWidth + uint(litPixel.x)] = seen;
    }
    uint evaluations = subgroupAdd(depth > 0.0 ? fieldEvaluations : 0u);
    if (subgroupElect())
        atomicAdd(Counters(pc.counters).block.fieldEvaluations, evaluations);
}
