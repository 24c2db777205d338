// What every pass of a frame may read: the camera, the environment, and where its baked light lies.
#ifndef SHARED_FRAME_H
#define SHARED_FRAME_H

const uint kMostShCoefficients = 25u; // 5 bands
const uint kLocalShCoefficients = 25u; // of light that comes in inside: 5 bands

struct BakedLight
{
    uint64_t texels; // uvec2[]: irradiance over the atlas, W/m^2, as in lib/float21.glsl
    uint64_t cells; // CellBlock[], x fastest, then y, then z
    vec3 origin; // of the first cell; world
    vec3 cellsPerMetre;
    ivec3 lastCell;
    ivec2 lastTexel;
    vec3 outside[kLocalShCoefficients]; // what comes in beyond the cells: the environment's radiance in the bake's bands, W/(m^2 sr)
    vec3 sentOn; // share of the irradiance on them that surfaces which hide light send to what they hide it from
};

struct FrameBlock
{
    mat4 clipFromWorld;
    vec3 eye; // world
    vec3 cornerRay; // from the eye through the corner of pixel (0, 0), one metre deep; world
    vec3 rayX; // and how it changes a pixel to the right
    vec3 rayY; // and a pixel down
    float near; // metres; view depth is near / reversed depth
    uint environment; // slot of the equirectangular map
    vec2 environmentTurn; // cosine and sine of its angle about +Y
    float environmentIntensity;
    vec3 radianceSh[kMostShCoefficients];   // of the environment, rotated and scaled; W/(m^2 sr)
    vec3 irradianceSh[kMostShCoefficients]; // the same, convolved with the clamped cosine; W/m^2
    BakedLight baked; // zero where there is none
};

#endif
