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
    uint pieces;
    uint fieldEvaluations;
    uint lightVertices; // corners of area lights, as pixels see them
    uint silhouetteVertices; // of what is before them, and may hide some of them
};

const uint kViewFinal = 0u;
const uint kViewUnshadowed = 1u;
const uint kViewOccluded = 2u;
const uint kViewDifference = 3u;
const uint kViewCones = 4u;
const uint kViewNormals = 5u;
const uint kViewReference = 6u;

const uint kAbsent = 0xffffffffu; // a slot of nothing

// Threads of a group, side by side: CPU devices read rows of an image at their caches' pace.
const uint kComposeGroupWidth = 64u;

struct Composite
{
    uint64_t counters;
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint albedo;
    uint unshadowed;
    uint traced; // traced pixels of the occluded irradiance
    uint areaDiffuse; // of area lights: W/m^2,
    uint areaSpecular; // W/(m^2 sr)
    int pixelScale; // of the pixels that things were found for to the G-buffer's: 1, 2, 4
    uint reference; // kAbsent: none
    uint isReferenceShown; // in place of what was traced
    uint picture; // written
    float exposure;
    uint color; // these three written where not kAbsent: W/(m^2 sr),
    uint irradiance; // W/m^2,
    uint occluded; // W/m^2 and cones a pixel
    uint view;
    uint splitX; // columns left of it show the final picture, the rest `view`
};

struct Sky
{
    uint frame; // slot of a FrameBlock
    float exposure;
};

#endif
