// The light that comes in at a place, from the cells about it that are open, and beyond them from the environment. Needs shared/frame.h.
#ifndef LIB_IRRADIANCE_VOLUME_GLSL
#define LIB_IRRADIANCE_VOLUME_GLSL

#include "lib/quad.glsl"
#include "lib/sh.glsl"
#include "shared/prt.h"

layout(buffer_reference, scalar) readonly buffer Cells { CellBlock cell[]; };

const uint kOpenness = 27u; // of a cell's values

// In cells from the first one.
vec3 placeInVolume(BakedLight baked, vec3 positionWorld) { return (positionWorld - baked.origin) * baked.cellsPerMetre; }

// 0 inside the outermost cells, 1 from one cell beyond them on: there the environment shines as it is.
float shareOutside(BakedLight baked, vec3 place)
{
    vec3 beyond = max(-place, place - vec3(baked.lastCell)) - 0.5;
    return clamp(max(beyond.x, max(beyond.y, beyond.z)), 0.0, 1.0);
}

// Adds the values in the first `wordCount` words of a cell about `place` with its trilinear weight; bits of `corner` say on which side
// it lies.
void addCell(BakedLight baked, vec3 place, uint corner, uint wordCount, inout float values[2 * kCellWords])
{
    ivec3 side = ivec3(corner & 1u, corner >> 1u & 1u, corner >> 2u);
    ivec3 lowest = ivec3(place), at = min(lowest + side, baked.lastCell);
    vec3 share = 1.0 - abs(vec3(lowest + side) - place);
    float weight = share.x * share.y * share.z;
    CellBlock cell = Cells(baked.cells).cell[(at.z * (baked.lastCell.y + 1) + at.y) * (baked.lastCell.x + 1) + at.x];
    for (uint i = 0u; i < wordCount; ++i) {
        vec2 pair = unpackHalf2x16(cell.halves[i]);
        values[2u * i] += weight * pair.x;
        values[2u * i + 1u] += weight * pair.y;
    }
}

vec3 coefficientAt(float values[2 * kCellWords], uint first) { return vec3(values[first], values[first + 1u], values[first + 2u]); }

// What sums over cells are to be multiplied by, of that openness. Where nothing is open, nothing was added: what lies within walls is dark.
float weightOfCells(float openness, float outside) { return (1.0 - outside) / max(openness * (1.0 - outside) + outside, 1.0e-6); }

// And the environment.
float weightOfEnvironment(float openness, float outside) { return outside / max(openness * (1.0 - outside) + outside, 1.0e-6); }

// The radiance that comes in, four bands, W/(m^2 sr).
void localRadiance(BakedLight baked, vec3 positionWorld, out vec3 radiance[16])
{
    vec3 place = placeInVolume(baked, positionWorld), inside = clamp(place, vec3(0.0), vec3(baked.lastCell));
    float values[2 * kCellWords], outside = shareOutside(baked, place);
    for (uint i = 0u; i < 2u * kCellWords; ++i)
        values[i] = 0.0;
    for (uint corner = 0u; corner < 8u; ++corner)
        addCell(baked, inside, corner, kCellWords, values);
    float whole = weightOfCells(values[kOpenness], outside), beyond = weightOfEnvironment(values[kOpenness], outside);
    for (uint j = 0u; j < 16u; ++j)
        radiance[j] = whole * coefficientAt(values, j < 9u ? 3u * j : 3u * j + 1u) + beyond * baked.outside[j];
}

// The irradiance of a surface there that faces `normal`, W/m^2: of three bands, in the middle of a quad's fragments, by all four: each adds
// two cells. What comes in changes little from pixel to pixel, and look-ups cost CPU devices most.
vec3 localIrradianceOfQuad(BakedLight baked, vec3 positionWorld, vec3 normal, bool isHelper)
{
    vec3 place = meanOverQuad(placeInVolume(baked, positionWorld), isHelper), inside = clamp(place, vec3(0.0), vec3(baked.lastCell));
    float values[2 * kCellWords], outside = shareOutside(baked, place);
    for (uint i = 0u; i < 2u * kCellWords; ++i)
        values[i] = 0.0;
    uint corner = gl_SubgroupInvocationID & 3u;
    addCell(baked, inside, corner, kIrradianceWords, values);
    addCell(baked, inside, corner + 4u, kIrradianceWords, values);
    for (uint i = 0u; i < 2u * kIrradianceWords; ++i) {
        values[i] += subgroupQuadSwapHorizontal(values[i]);
        values[i] += subgroupQuadSwapVertical(values[i]);
    }
    vec3 radiance[9];
    for (uint j = 0u; j < 9u; ++j)
        radiance[j] = coefficientAt(values, 3u * j);
    vec3 irradiance = weightOfCells(values[kOpenness], outside) * irradianceOfSh3(radiance, normal);
    // A loop that goes round for nobody is what spares CPU devices the work.
    uint rounds = outside > 0.0 ? 1u : 0u;
    for (uint i = 0u; i < rounds; ++i) {
        for (uint j = 0u; j < 9u; ++j)
            radiance[j] = baked.outside[j];
        irradiance += weightOfEnvironment(values[kOpenness], outside) * irradianceOfSh3(radiance, normal);
    }
    return irradiance;
}

#endif
