// Area light that was found for some pixels, for all of them, where these are others than those whose occlusion was traced: else composition
// takes both from the same squares of pixels. Variant GLOSSY: what is reflected by GGX too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/area.h"
#include "shared/composite.h"
#include "lib/upsample.glsl"

layout(local_size_x = kComposeGroupWidth) in; // a thread a block of pixels
layout(push_constant, scalar) uniform Push { AreaUpsample pc; };

Found foundAt(ivec2 place)
{
    Found found = surfaceFound(frameBlock, pc.depth, pc.normals, place, pc.pixelScale);
    found.diffuse = texelFetch(sampledImages[pc.diffuseLit], place, 0).rgb;
#ifdef GLOSSY
    found.specular = texelFetch(sampledImages[pc.specularLit], place, 0).rgb;
#endif
    return found;
}

bool finishPixel(PixelBlock block, ivec2 pixel, bool asksRing)
{
    float depth = texelFetch(sampledImages[pc.depth], pixel, 0).x;
    if (depth <= 0.0)
        return true;
    vec3 normal = unitFromOctahedral(texelFetch(sampledImages[pc.normals], pixel, 0).zw);
    bool isEnough;
    Found found = upsampled(block, pixel, pixelPlane(frameBlock, vec2(pixel) + 0.5, frameBlock.near / depth, normal), asksRing, isEnough);
    imageStore(storageImages[pc.diffuse], pixel, vec4(found.diffuse, 0.0));
#ifdef GLOSSY
    imageStore(storageImages[pc.specular], pixel, vec4(found.specular, 0.0));
#endif
    return isEnough;
}

void main()
{
    ivec2 extent = textureSize(sampledImages[pc.depth], 0);
    PixelBlock block = blockOf(ivec2(gl_GlobalInvocationID.xy), pc.pixelScale, extent);
    if (all(lessThan(block.first, extent)))
        finishBlock(block, extent);
}
