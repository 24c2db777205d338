// What was found for one pixel in every square of them, for all of them: joint-bilateral upsampling (Kopf et al. 2007). Of the four squares
// about a pixel those on its own surface count, so that contact shadows stay where surfaces meet; where none is, the ring about the four is
// asked, then the likest is taken. Pixels that lie between the same four are a block, and one thread's.
// Whoever includes it says what is found at a square and what becomes of a pixel. Needs lib/bindless.glsl, shared/frame.h.
#ifndef LIB_UPSAMPLE_GLSL
#define LIB_UPSAMPLE_GLSL

#include "lib/lit_extent.glsl"
#include "lib/surface.glsl"
#include "lib/traced.glsl"

struct Found
{
    float depthView; // of the pixel it was found for, metres; 0: no surface
    vec3 normal; // shading
    vec3 hidden; // as of a TracedPixel
    vec4 occluded; // irradiance that is hidden from the surface, W/m^2; cones in a
    vec3 diffuse; // of area lights, W/m^2
    vec3 specular; // W/(m^2 sr)
};

Found nothingFound() { return Found(0.0, vec3(0.0), vec3(0.0), vec4(0.0), vec3(0.0), vec3(0.0)); }

// For a surface that faces that way.
Found turned(Found found, vec3 normal)
{
    float there = sumOf(found.occluded.rgb);
    found.occluded.rgb *= lackedBy(normal, found.hidden) / max(there, 1.0e-30);
    return found;
}

// The surface in the middle of a square, which nothing is found for yet; `depths` and `normals` are slots of the G-buffer.
Found surfaceFound(FrameBlock frame, uint depths, uint normals, ivec2 place, int pixelScale)
{
    ivec2 pixel = litAt(place, pixelScale, textureSize(sampledImages[depths], 0));
    float depth = texelFetch(sampledImages[depths], pixel, 0).x;
    Found found = nothingFound();
    found.depthView = depth > 0.0 ? frame.near / depth : 0.0;
    found.normal = unitFromOctahedral(texelFetch(sampledImages[normals], pixel, 0).zw);
    return found;
}

struct PixelBlock
{
    ivec2 corner; // upper left of the four squares
    ivec2 first; // pixel of the block
    int pixelScale; // pixels along a square, and along the block
    ivec2 lastPlace; // of all squares
};

Found foundAt(ivec2 place);

// False where the four squares have little to say for the pixel and the ring was not to be asked.
bool finishPixel(PixelBlock block, ivec2 pixel, bool asksRing);

Found around[4];
ivec2 placesAround[4]; // from the block's corner

// Blocks at the picture's upper and left edge begin outside.
PixelBlock blockOf(ivec2 thread, int pixelScale, ivec2 extent)
{
    ivec2 corner = thread - 1;
    return PixelBlock(corner, corner * pixelScale + pixelScale / 2, pixelScale, litExtent(extent, pixelScale) - 1);
}

// At the picture's edge the nearest stands in.
ivec2 placeBeside(PixelBlock block, ivec2 steps) { return clamp(block.corner + steps, ivec2(0), block.lastPlace) - block.corner; }

// The ring about the four, as steps of -1..2 of two bits each: in two words instead of an array in memory.
ivec2 ringSteps(uint k) { return ivec2(uvec2(0xcc99f0u, 0xf0f099u) >> 2u * k & 3u) - 1; }

struct Upsampling
{
    Found sum;
    float weights;
    Found likest;
    float mostLike;
};

void take(inout Upsampling u, PixelPlane plane, vec2 offset, Found found, float near)
{
    float like = likeness(plane, offset, found.depthView, found.normal), weight = like * near;
    u.sum.hidden += weight * found.hidden;
    u.sum.occluded += weight * found.occluded;
    u.sum.diffuse += weight * found.diffuse;
    u.sum.specular += weight * found.specular;
    u.weights += weight;
    if (like > u.mostLike)
        u.likest = found;
    u.mostLike = max(u.mostLike, like);
}

// For a pixel of the block, whose surface is in the plane.
Found upsampled(PixelBlock block, ivec2 pixel, PixelPlane plane, bool asksRing, out bool isEnough)
{
    const float kEnough = 0.05, kRingWeight = 0.1;
    float scale = float(block.pixelScale);
    // What was found stands where it was found: in the middle of its square.
    vec2 origin = vec2(block.first - pixel), at = -origin / scale;
    Upsampling u = Upsampling(nothingFound(), 0.0, nothingFound(), -1.0);
    for (int k = 0; k < 4; ++k) {
        vec2 near = mix(1.0 - at, at, bvec2(k & 1, k >> 1));
        take(u, plane, origin + scale * vec2(placesAround[k]), around[k], near.x * near.y);
    }
    isEnough = u.weights >= kEnough || asksRing;
    if (asksRing)
        for (uint k = 0u; k < 12u && u.weights < kEnough; ++k) {
            ivec2 place = placeBeside(block, ringSteps(k));
            take(u, plane, origin + scale * vec2(place), foundAt(block.corner + place), kRingWeight);
        }
    if (u.weights <= 1.0e-3)
        return turned(u.likest, plane.normal);
    float whole = 1.0 / u.weights;
    u.sum.hidden *= whole;
    u.sum.occluded *= whole;
    u.sum.diffuse *= whole;
    u.sum.specular *= whole;
    return turned(u.sum, plane.normal);
}

void finishBlock(PixelBlock block, ivec2 extent)
{
    int scale = block.pixelScale;
    for (int k = 0; k < 4; ++k) {
        placesAround[k] = placeBeside(block, ivec2(k & 1, k >> 1));
        around[k] = foundAt(block.corner + placesAround[k]);
    }
    uint unfinished = 0u; // bits of the block's pixels
    for (int y = 0; y < scale; ++y)
        for (int x = 0; x < scale; ++x) {
            ivec2 pixel = block.first + ivec2(x, y);
            if (all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, extent)) && !finishPixel(block, pixel, false))
                unfinished |= 1u << (y * scale + x);
        }
    // Apart, for the whole block: rows of pixels would wait, pixel by pixel, for the few that need it.
    for (; unfinished != 0u; unfinished &= unfinished - 1u) {
        int i = findLSB(unfinished);
        finishPixel(block, block.first + ivec2(i % scale, i / scale), true);
    }
}

#endif
