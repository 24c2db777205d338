// From irradiance to the picture.
#ifndef SHARED_COMPOSITE_H
#define SHARED_COMPOSITE_H

// What the overlay, the stats and the tests read; counted by the passes.
struct CounterBlock
{
    uint raysConsidered;
    uint raysTraced;
    uint cones;
    uint clampedPixels;
    uint nanPixels;
    uint infPixels;
    uint negativePixels;
    uint fallbackPixels;
};

const uint kViewFinal = 0u;
const uint kViewUnshadowed = 1u;
const uint kViewOccluded = 2u;
const uint kViewDifference = 3u;
const uint kViewCones = 4u;
const uint kViewNormals = 5u;
const uint kViewReference = 6u;

const uint kNoOcclusion = 0xffffffffu;

struct Composite
{
    uint64_t counters;
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint albedo;
    uint unshadowed;
    uint occluded; // kNoOcclusion: nothing moves
    uint reference; // kNoOcclusion: none
    uint color; // written
    uint irradiance; // written
    uint view;
    uint splitX; // columns left of it show the final picture, the rest `view`
    uint hasIrradiance; // 0: `irradiance` is not asked for
};

struct Sky
{
    uint frame; // slot of a FrameBlock
};

struct Tonemap
{
    uint color;
    uint picture;
    float exposure;
};

#endif
