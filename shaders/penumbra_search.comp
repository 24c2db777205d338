// A penumbra from hard shadows: how near on the screen the border of the shadow is, over how wide its penumbra is. The article's (Kissner,
// methods/penumbra.md) softens what is hidden alone; variant TWO_SIDED softens both sides and measures in the world.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/light_share.h"
#include "lib/bodies.glsl"
#include "lib/lit_extent.glsl"
#include "lib/penumbra.glsl"
#include "lib/spread.glsl"
#include "lib/surface.glsl"

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Rays { ShadowRay ray[]; };
layout(buffer_reference, scalar) writeonly buffer Shares { vec2 value[]; };
layout(push_constant, scalar) uniform Push { PenumbraSearch pc; };

layout(local_size_x = kAreaGroupWidth, local_size_y = kAreaGroupHeight) in;

const int kStepsASide = 6; // of the grid that is searched
const float kMostPixels = 48.0; // of the G-buffer, to each side
const float kNone = 1.0e30; // no border

ivec2 extent, lit;

struct Place
{
    ivec2 litPixel;
    uint firstPixel; // of the light
    vec3 position; // world
    vec3 toLight; // unit
    ShadowRay ray;
    float reach; // lit pixels that the penumbra is wide
};

vec3 positionOf(ivec2 litPixel)
{
    ivec2 pixel = litAt(litPixel, pc.pixelScale, extent);
    return worldPosition(frameBlock, vec2(pixel) + 0.5, max(texelFetch(sampledImages[pc.depth], pixel, 0).x, 1.0e-30));
}

// Where the border to the pixel so far off lies: 0 at the pixel, 1 at the penumbra's end.
float borderAt(Place here, ivec2 offset)
{
    ivec2 there = here.litPixel + offset;
    bool isInside = all(greaterThanEqual(there, ivec2(0))) && all(lessThan(there, lit)) && offset != ivec2(0);
    there = isInside ? there : here.litPixel;
    ShadowRay ray = Rays(pc.rays).ray[here.firstPixel + uint(there.y * lit.x + there.x)];
    bool isKnown = isInside && texelFetch(sampledImages[pc.depth], litAt(there, pc.pixelScale, extent), 0).x > 0.0;
#ifdef TWO_SIDED
    bool isHidden = here.ray.halfPenumbra > 0.0;
    bool isOther = isHidden ? ray.halfPenumbra == kLit : ray.halfPenumbra > 0.0;
    vec3 apart = positionOf(there) - here.position;
    float nearer = dot(apart, here.toLight);
    // From what hides one of the two, the way of both to the light is looked at: where the other is past it, there is no border.
    float before = isHidden ? here.ray.blocker - nearer : ray.blocker + nearer;
    float halfPenumbra = isHidden ? here.ray.halfPenumbra : ray.halfPenumbra * before / max(ray.blocker, 1.0e-6);
    // The border lies half a pixel before.
    float across = length(apart - here.toLight * nearer) * (1.0 - 0.5 / max(length(vec2(offset)), 1.0));
    return isKnown && isOther && before > 0.0 ? across / max(halfPenumbra, 1.0e-6) : kNone;
#else
    return isKnown && ray.halfPenumbra == kLit ? length(vec2(offset)) / here.reach : kNone;
#endif
}

// The nearest border on a grid, then on ever finer ones about it.
float nearestBorder(Place here, int spacing)
{
    float nearest = kNone;
    ivec2 at = ivec2(0);
    for (int y = -kStepsASide; y <= kStepsASide; ++y)
        for (int x = -kStepsASide; x <= kStepsASide; ++x) {
            float border = borderAt(here, spacing * ivec2(x, y));
            at = border < nearest ? spacing * ivec2(x, y) : at;
            nearest = min(border, nearest);
        }
    while (spacing > 1 && nearest < kNone) {
        spacing = (spacing + 1) / 2;
        ivec2 about = at;
        for (int k = 0; k < 9; ++k) {
            ivec2 offset = about + spacing * (ivec2(k % 3, k / 3) - 1);
            float border = borderAt(here, offset);
            at = border < nearest ? offset : at;
            nearest = min(border, nearest);
        }
    }
    return nearest;
}

float shareSeen(Place here)
{
#ifdef TWO_SIDED
    bool isSearched = here.ray.halfPenumbra >= kLit;
    float pixels = here.ray.halfPenumbra > 0.0 ? here.reach : kMostPixels;
#else
    bool isSearched = here.ray.halfPenumbra > 0.0;
    float pixels = here.reach;
#endif
    if (!isSearched)
        return 1.0;
    int spacing = int(ceil(clamp(pixels, 1.0, kMostPixels / float(pc.pixelScale)) / float(kStepsASide)));
    float border = nearestBorder(here, spacing);
#ifdef TWO_SIDED
    return diskPast(here.ray.halfPenumbra > 0.0 ? -border : border);
#else
    return 1.0 - min(border, 1.0);
#endif
}

void main()
{
    ivec2 litPixel = ivec2(spreadInvocation(kAreaGroupHeight));
    extent = textureSize(sampledImages[pc.depth], 0);
    lit = litExtent(extent, pc.pixelScale);
    if (any(greaterThanEqual(litPixel, lit)))
        return;
    float depth = texelFetch(sampledImages[pc.depth], litAt(litPixel, pc.pixelScale, extent), 0).x;
    if (depth <= 0.0)
        return;
    AreaBlock area = Areas(pc.area).block;
    vec3 position = positionOf(litPixel);
    float litPixelsAMetre = depth / (frameBlock.near * length(frameBlock.rayX) * float(pc.pixelScale));
    for (uint i = pc.firstLight; i < pc.endLight; ++i) {
        uint first = (i - pc.firstLight) * uint(lit.x * lit.y), at = first + uint(litPixel.y * lit.x + litPixel.x);
        ShadowRay ray = Rays(pc.rays).ray[at];
        vec3 toLight = Bodies(area.arrays.bodies).body[Lights(area.lights).block[i].body].centre - position;
#ifdef TWO_SIDED
        float reach = ray.halfPenumbra * litPixelsAMetre;
#else
        float reach = 2.0 * ray.halfPenumbra * litPixelsAMetre;
#endif
        Place here = Place(litPixel, first, position, toLight / max(length(toLight), 1.0e-10), ray, max(reach, 1.0e-3));
        Shares(pc.shares).value[at] = vec2(shareSeen(here));
    }
}
