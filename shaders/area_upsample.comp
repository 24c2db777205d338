// Area light that was found for some pixels, for all of them, by joint-bilateral upsampling (Kopf et al. 2007). Variant GLOSSY: what is
// reflected by GGX too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/area.h"
#include "lib/lit_extent.glsl"
#include "lib/spread.glsl"
#include "lib/surface.glsl"

layout(push_constant, scalar) uniform Push { AreaUpsample pc; };

layout(local_size_x = 8, local_size_y = 8) in; // a thread a block of pixels that lie between the same four that were lit

struct LitPixel
{
    vec3 diffuse;
    vec3 specular;
    vec3 normal;
    float depthView; // 0: no surface
};

ivec2 fullExtent;

LitPixel litPixel(ivec2 place)
{
    ivec2 pixel = litAt(place, pc.pixelScale, fullExtent);
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    LitPixel lit;
    lit.diffuse = texelFetch(sampledImages[pc.diffuseLit], place, 0).rgb;
    lit.specular = vec3(0.0);
#ifdef GLOSSY
    lit.specular = texelFetch(sampledImages[pc.specularLit], place, 0).rgb;
#endif
    lit.normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    lit.depthView = depth > 0.0 ? frameBlock.near / depth : 0.0;
    return lit;
}

LitPixel around[4];
ivec2 places[4];

// Of the four around, those on the pixel's own surface count; where none is, the likest is taken.
void upsample(ivec2 pixel, ivec2 corner, float depthView)
{
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    PixelPlane plane = pixelPlane(frameBlock, vec2(pixel) + 0.5, depthView, normal);
    float scale = float(pc.pixelScale);
    vec2 origin = vec2(corner * pc.pixelScale + pc.pixelScale / 2 - pixel);
    vec2 at = -origin / scale;
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    float weights = 0.0, mostLike = -1.0;
    int likest = 0;
    for (int k = 0; k < 4; ++k) {
        LitPixel there = around[k];
        float like = there.depthView > 0.0
                         ? samePlane(plane, origin + scale * vec2(places[k]), there.depthView) * sameFacing(plane, there.normal)
                         : 0.0;
        vec2 near = mix(1.0 - at, at, bvec2(k & 1, k >> 1));
        float weight = like * near.x * near.y;
        diffuse += weight * there.diffuse;
        specular += weight * there.specular;
        weights += weight;
        likest = like > mostLike ? k : likest;
        mostLike = max(like, mostLike);
    }
    bool isKnown = weights > 1.0e-3;
    imageStore(storageImages[pc.diffuse], pixel, vec4(isKnown ? diffuse / weights : around[likest].diffuse, 0.0));
#ifdef GLOSSY
    imageStore(storageImages[pc.specular], pixel, vec4(isKnown ? specular / weights : around[likest].specular, 0.0));
#endif
}

void main()
{
    fullExtent = textureSize(sampledImages[pc.depth], 0);
    ivec2 corner = ivec2(spreadInvocation(8u)) - 1;
    ivec2 first = corner * pc.pixelScale + pc.pixelScale / 2;
    if (any(greaterThanEqual(first, fullExtent)))
        return;
    ivec2 lastPlace = textureSize(sampledImages[pc.diffuseLit], 0) - 1;
    for (int k = 0; k < 4; ++k) {
        places[k] = clamp(corner + ivec2(k & 1, k >> 1), ivec2(0), lastPlace) - corner;
        around[k] = litPixel(corner + places[k]);
    }
    for (int y = 0; y < pc.pixelScale; ++y)
        for (int x = 0; x < pc.pixelScale; ++x) {
            ivec2 pixel = first + ivec2(x, y);
            if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, fullExtent)))
                continue;
            float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
            if (depth > 0.0)
                upsample(pixel, corner, frameBlock.near / depth);
        }
}
