// Light of area lights that reaches what is seen, past what stands before them. Variants: SHADOW is kAreaUnshadowed (times shares that others
// found), kAreaAnalytic (KT et al. 2021, methods/area-shadows.md) or kAreaTraced (points on the light, a shadow ray each); REFERENCE draws its
// points anew each frame; GLOSSY reflects by GGX too; COMPUTE_BVH traces without ray queries; FIELDS: rays meet distance fields too; TRIANGLES
// and sizes as in lib/area.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lib/frame.glsl"
#include "shared/composite.h"
#include "shared/field.h"
#include "shared/occlusion.h"
#ifndef SHADOW
#define SHADOW 1
#endif
#ifndef POLYGON_PLACES
#define POLYGON_PLACES 12
#define POLYGON_CORNERS 32
#define SILHOUETTE_EDGES 128
#define SILHOUETTE_BODY_EDGES 64
#define FACE_WORDS 4
#define OUTLINE_CORNERS 30
#define LIGHT_VERTICES 64
#define AREA_OCCLUDERS 8
#define AREA_SIGNED 8
#endif
#ifdef GLOSSY
#define TWO_LOBES
#endif
#include "lib/area.glsl"
#include "lib/blocked.glsl"
#include "lib/lit_surface.glsl"
#include "lib/spread.glsl"
#ifdef GLOSSY
#include "lib/ltc.glsl"
#include "lib/ggx.glsl"
#endif
#if SHADOW == 2
#ifdef COMPUTE_BVH
#include "lib/bvh.glsl"
#else
#include "lib/ray_query.glsl"
#endif
#include "lib/light_points.glsl"
#include "lib/light_samples.glsl"
#ifdef FIELDS
#include "lib/field.glsl"
#include "lib/field_ray.glsl"
#include "lib/field_boxes.glsl"
#endif
#endif

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Tiles { AreaTileBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Owners { uint light[]; };
layout(buffer_reference, scalar) readonly buffer Shares { vec2 value[]; };
layout(buffer_reference, scalar) readonly buffer Seen { float share[]; };
layout(buffer_reference, scalar) buffer Counters { CounterBlock block; };
layout(push_constant, scalar) uniform Push { AreaShade pc; };

layout(local_size_x = kAreaGroupWidth, local_size_y = kAreaGroupHeight) in;

struct Received
{
    vec3 diffuse; // W/m^2, cosine-weighted
    vec3 specular; // W/(m^2 sr) towards the eye
};

const uint kMostMattering = 24u; // occluders of a pixel and light whose spheres meet the light's cone
uint matters[kMostMattering];
bool isMoving = false; // what is shaded
uint matterCount = 0u;
uint pieceCount = 0u, lightVertexCount = 0u, silhouetteVertexCount = 0u;
bool isFallback = false;

#if SHADOW == 2

bool isHidden(AreaBlock area, LitSurface s, LightSample point)
{
    bool isHidden = distanceToBlocker(pc.scene, kMaskAll, s.position, point.direction, point.before, true) >= 0.0;
#ifdef FIELDS
    FieldsBlock fields = Fields(area.fields).block;
    FieldRay ray = fieldRay(s.position, point.direction);
    if (!isHidden)
        addGroups(pc.scene, fields, point.before, ray);
    isHidden = isHidden || distanceToField(fields, ray) >= 0.0;
#endif
    return isHidden;
}

Received received(AreaBlock area, AreaLightBlock light, uint index, LitSurface s, ivec2 pixel)
{
    BodyArrays arrays = area.arrays;
    BodyBlock body = Bodies(arrays.bodies).body[light.body];
    Received sum = Received(vec3(0.0), vec3(0.0));
    float squareMetres = litArea(arrays, body, s.position);
    vec2 shift = pointShift(pixel, index);
    uint first = 0u;
#ifdef REFERENCE
    first = pc.frameIndex * pc.rays;
#endif
    for (uint i = 0u; i < pc.rays && squareMetres > 0.0; ++i) {
        LightSample point = lightSample(arrays, body, s, squareMetres, pointOfSequence(shift, first + i));
        if (point.diffuse == 0.0 || isHidden(area, s, point))
            continue;
        sum = Received(sum.diffuse + point.diffuse, sum.specular + point.specular);
    }
    vec3 scale = light.radiance / float(max(pc.rays, 1u));
    return Received(sum.diffuse * scale, sum.specular * scale);
}

#else

// Any corner is above the surface's plane.
bool isOutlineAbove(vec3 normal)
{
    float highest = -1.0;
    for (int i = 0; i < outlineCount; ++i)
        highest = max(highest, dot(normal, outline[i]));
    return highest > 0.0;
}

void addOccluders(AreaBlock area, uint index, BodyBlock body, LitSurface s, ivec2 pixel)
{
    uvec2 tile = uvec2(pixel) / kAreaTileSize;
    uint at = (tile.y * area.tilesAcross + tile.x) * area.lightCount + index;
    uint count = Tiles(pc.tiles).block[at].count;
    bool isListed = count <= kAreaTileOccluders;
    count = isListed ? count : area.occluderCount;
    // First whose spheres may matter, then those themselves: the pixels of a group look at as many as one of them must.
    uint mattering = 0u;
    for (uint i = 0u; i < count; ++i) {
        uint occluder = isListed ? Tiles(pc.tiles).block[at].occluders[i] : area.firstOccluder + i;
        bool isOwn = !isListed && Owners(area.owners).light[i] == Lights(area.lights).block[index].light;
        BodyBlock blocker = Bodies(area.arrays.bodies).body[occluder];
        bool may = !isOwn && dot(s.normal, blocker.centre - s.position) > -blocker.radius && mayHide(blocker, s.position);
        matters[min(mattering, kMostMattering - 1u)] = occluder;
        mattering += may ? 1u : 0u;
    }
    isOccluderLost = mattering > kMostMattering;
    matterCount = min(mattering, kMostMattering);
    for (uint i = 0u; i < min(mattering, kMostMattering) && !isAllHidden; ++i)
        addOccluder(area.arrays, body, occluderBefore(area.arrays, matters[i], isMoving), s.position);
}

// Share of points on the light's outline that are seen past all that matters: where there is more of it than the closed form has room for.
float sampledPast(BodyArrays arrays, vec3 point, bool isWanted)
{
    uint samples = isWanted ? 16u : 0u;
    float seen = 0.0;
    for (uint i = 0u; i < samples; ++i) {
        uint triangle = 1u + i % uint(outlineCount - 2);
        float u = sqrt((float(i) + 0.5) / float(samples)), v = radicalInverse2(i);
        vec3 to = outline[0] * (1.0 - u) + outline[triangle] * (u * (1.0 - v)) + outline[triangle + 1u] * (u * v);
        bool isPast = true;
        for (uint k = 0u; k < matterCount && isPast; ++k)
            isPast = !blocksWay(arrays, occluderBefore(arrays, matters[k], isMoving), point, to);
        seen += isPast ? 1.0 / float(samples) : 0.0;
    }
    return seen;
}

// Of the light, or of its face `litFace`.
Received receivedOf(AreaBlock area, AreaLightBlock light, uint index, BodyBlock body, LitSurface s, ivec2 pixel)
{
    if (!beginLight(area.arrays, body, s.position) || !isOutlineAbove(s.normal))
        return Received(vec3(0.0), vec3(0.0));
#if SHADOW == 1
    addOccluders(area, index, body, s, pixel);
#endif
#ifdef GLOSSY
    LtcLobe lobe = ltcLobe(pc.ltcMatrix, pc.ltcAmplitude, s.roughness, clamp(dot(s.normal, s.toEye), 0.0, 1.0));
    secondLobe = lobe.toCosine;
#endif
    AreaShare diffuse = areaShare(s.tangentSpace, s.normal, pc.mostPieces);
#if SHADOW == 1
    float past = sampledPast(area.arrays, s.position, isOccluderLost && !isAllHidden);
    diffuse.visible = isOccluderLost && !isAllHidden ? min(diffuse.visible, past * diffuse.unoccluded) : diffuse.visible;
#ifdef GLOSSY
    secondShare.visible = isOccluderLost && !isAllHidden ? min(secondShare.visible, past * secondShare.unoccluded) : secondShare.visible;
#endif
#endif
    pieceCount += diffuse.pieces;
    lightVertexCount += uint(outlineCount);
    silhouetteVertexCount += uint(edgeCount);
    isFallback = isFallback || diffuse.fallbacks > 0u || isOccluderLost || isLightLost;
    Received sum = Received(light.radiance * (kPi * diffuse.visible), vec3(0.0));
#ifdef GLOSSY
    sum.specular = light.radiance * (s.f0 * lobe.amplitude.x + (1.0 - s.f0) * lobe.amplitude.y) * secondShare.visible;
#endif
    return sum;
}

Received received(AreaBlock area, AreaLightBlock light, uint index, LitSurface s, ivec2 pixel)
{
    BodyBlock body = Bodies(area.arrays.bodies).body[light.body];
#ifdef TRIANGLES
    Received sum = Received(vec3(0.0), vec3(0.0));
    for (litFace = 0u; litFace < body.faceCount; ++litFace) {
        Received one = receivedOf(area, light, index, body, s, pixel);
        sum = Received(sum.diffuse + one.diffuse, sum.specular + one.specular);
    }
    return sum;
#else
    return receivedOf(area, light, index, body, s, pixel);
#endif
}

#endif

void count(Received sum)
{
    vec3 both = sum.diffuse + sum.specular;
    bool nan = any(isnan(both)), inf = !nan && any(isinf(both)), negative = !nan && any(lessThan(min(sum.diffuse, sum.specular), vec3(0.0)));
    uint pieces = subgroupAdd(pieceCount), fallbacks = subgroupAdd(uint(isFallback)), nans = subgroupAdd(uint(nan)),
         infs = subgroupAdd(uint(inf)), negatives = subgroupAdd(uint(negative)), corners = subgroupAdd(lightVertexCount),
         silhouettes = subgroupAdd(silhouetteVertexCount);
    if (!subgroupElect() || pieces + fallbacks + nans + infs + negatives == 0u)
        return;
    atomicAdd(Counters(pc.counters).block.pieces, pieces);
    atomicAdd(Counters(pc.counters).block.lightVertices, corners);
    atomicAdd(Counters(pc.counters).block.silhouetteVertices, silhouettes);
    atomicAdd(Counters(pc.counters).block.fallbackPixels, fallbacks);
    atomicAdd(Counters(pc.counters).block.nanPixels, nans);
    atomicAdd(Counters(pc.counters).block.infPixels, infs);
    atomicAdd(Counters(pc.counters).block.negativePixels, negatives);
}

vec3 addedUp(uint before, ivec2 pixel, vec3 value)
{
    vec3 sum = before != kNothingBefore ? texelFetch(sampledImages[before], pixel, 0).rgb : vec3(0.0);
#ifdef REFERENCE
    return pc.rays > 0u ? sum + (value - sum) / float(pc.frameIndex + 1u) : sum;
#else
    return sum + value;
#endif
}

// Of the light that is reflected diffusely, and by GGX.
vec2 shareSeen(uint light, uint litPixel, uint litPixels)
{
    vec2 share = vec2(1.0);
    if (pc.shares != 0ul)
        share = Shares(pc.shares).value[(light - pc.firstLight) * litPixels + litPixel];
    if (pc.seenPastFields != 0ul)
        share *= Seen(pc.seenPastFields).share[light * litPixels + litPixel];
    return share;
}

void main()
{
#if SHADOW == 2 && defined(FIELDS)
    holdSteps(Fields(Areas(pc.area).block.fields).block);
#endif
    ivec2 litPixel = ivec2(spreadInvocation(kAreaGroupHeight)), extent = textureSize(sampledImages[pc.depth], 0);
    ivec2 lit = litExtent(extent, pc.pixelScale), pixel = litAt(litPixel, pc.pixelScale, extent);
    bool isInside = all(lessThan(litPixel, lit));
    float depth = isInside ? texelFetch(sampledImages[pc.depth], pixel, 0).x : 0.0;
    Received sum = Received(vec3(0.0), vec3(0.0));
    if (depth > 0.0) {
        AreaBlock area = Areas(pc.area).block;
        LitSurface s = litSurface(frameBlock, SurfaceImages(pc.normals, pc.albedo, pc.material), pixel, depth);
        mostPlanes = pc.mostPlanes;
        isMoving = texelFetch(sampledImages[pc.albedo], pixel, 0).a > 0.5;
        for (uint i = pc.firstLight; i < pc.endLight; ++i) {
            AreaLightBlock light = Lights(area.lights).block[i];
            Received one = received(area, light, i, s, pixel);
            vec2 seen = shareSeen(i, uint(litPixel.y * lit.x + litPixel.x), uint(lit.x * lit.y));
            sum = Received(sum.diffuse + seen.x * one.diffuse, sum.specular + seen.y * one.specular);
        }
        sum.diffuse *= s.diffuse;
    }
    count(sum);
    if (!isInside)
        return;
    imageStore(storageImages[pc.diffuse], litPixel, vec4(addedUp(pc.diffuseBefore, litPixel, sum.diffuse), 0.0));
#ifdef GLOSSY
    imageStore(storageImages[pc.specular], litPixel, vec4(addedUp(pc.specularBefore, litPixel, sum.specular), 0.0));
#endif
}
