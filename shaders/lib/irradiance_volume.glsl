// The light that comes in at a place, from the cells about it that are open, and beyond them from the environment. Needs shared/frame.h.
#ifndef LIB_IRRADIANCE_VOLUME_GLSL
#define LIB_IRRADIANCE_VOLUME_GLSL

#include "lib/float21.glsl"
#include "lib/quad.glsl"
#include "lib/sh.glsl"
#include "lib/whole.glsl"
#include "shared/prt.h"

// Of CellBlocks, both words at once: CPU devices gather them as fast as one.
layout(buffer_reference, scalar) readonly buffer Cells { uint64_t radiance[]; };

// In cells from the first one.
vec3 placeInVolume(BakedLight baked, vec3 positionWorld) { return (positionWorld - baked.origin) * baked.cellsPerMetre; }

// 0 inside the outermost cells, 1 from one cell beyond them on: there the environment shines as it is.
float shareOutside(BakedLight baked, vec3 place)
{
    vec3 beyond = max(-place, place - vec3(baked.lastCell)) - 0.5;
    return clamp(max(beyond.x, max(beyond.y, beyond.z)), 0.0, 1.0);
}

// Sums over the cells about a place.
struct CellSum
{
    vec3 radiance[kLocalShCoefficients];
    float openness;
};

CellSum noCells()
{
    CellSum sum;
    for (uint i = 0u; i < kLocalShCoefficients; ++i)
        sum.radiance[i] = vec3(0.0);
    sum.openness = 0.0;
    return sum;
}

// Adds so many coefficients of a cell with its trilinear weight; bits of `corner` say on which side of the lowest cell about `place` it lies.
void addCell(BakedLight baked, vec3 place, ivec3 lowest, uint corner, uint coefficientCount, inout CellSum sum)
{
    ivec3 cell = lowest + ivec3(corner & 1u, corner >> 1u & 1u, corner >> 2u), at = min(cell, baked.lastCell);
    vec3 share = 1.0 - abs(vec3(cell) - place);
    float weight = share.x * share.y * share.z;
    uint first = kLocalShCoefficients * uint((at.z * (baked.lastCell.y + 1) + at.y) * (baked.lastCell.x + 1) + at.x);
    Cells cells = Cells(baked.cells);
    for (uint i = 0u; i < coefficientCount; ++i) {
        uvec2 words = unpackUint2x32(cells.radiance[first + i]);
        sum.radiance[i] += weight * unpackFloats21(words);
        sum.openness += i == 0u ? weight * float(words.y & kCellIsOpen) : 0.0;
    }
}

// What sums over cells are to be multiplied by, of that openness. Where nothing is open, nothing was added: what lies within walls is dark.
float weightOfCells(float openness, float outside) { return (1.0 - outside) / max(openness * (1.0 - outside) + outside, 1.0e-6); }

// And the environment.
float weightOfEnvironment(float openness, float outside) { return outside / max(openness * (1.0 - outside) + outside, 1.0e-6); }

// The radiance that comes in, four bands, W/(m^2 sr).
void localRadiance(BakedLight baked, vec3 positionWorld, out vec3 radiance[kLocalShCoefficients])
{
    vec3 place = placeInVolume(baked, positionWorld), inside = clamp(place, vec3(0.0), vec3(baked.lastCell));
    ivec3 lowest = wholeOf(inside);
    CellSum sum = noCells();
    for (uint corner = 0u; corner < 8u; ++corner)
        addCell(baked, inside, lowest, corner, kLocalShCoefficients, sum);
    float outside = shareOutside(baked, place);
    float whole = weightOfCells(sum.openness, outside), beyond = weightOfEnvironment(sum.openness, outside);
    for (uint i = 0u; i < kLocalShCoefficients; ++i)
        radiance[i] = whole * sum.radiance[i] + beyond * baked.outside[i];
}

// The irradiance of level surfaces there, of one that faces up and of one that faces down, W/m^2.
void irradianceAboveAndBelow(BakedLight baked, vec3 positionWorld, out vec3 above, out vec3 below)
{
    vec3 radiance[kLocalShCoefficients], three[9];
    localRadiance(baked, positionWorld, radiance);
    for (uint i = 0u; i < 9u; ++i)
        three[i] = radiance[i];
    above = irradianceOfSh3(three, vec3(0.0, 1.0, 0.0));
    below = irradianceOfSh3(three, vec3(0.0, -1.0, 0.0));
}

// The irradiance of a surface there that faces `normal`, W/m^2: of three bands, in the middle of a quad's fragments, by all four: each adds
// two cells. What comes in changes little from pixel to pixel, and look-ups cost CPU devices most.
vec3 localIrradianceOfQuad(BakedLight baked, vec3 positionWorld, vec3 normal, bool isHelper)
{
    vec3 place = meanOverQuad(placeInVolume(baked, positionWorld), isHelper), inside = clamp(place, vec3(0.0), vec3(baked.lastCell));
    ivec3 lowest = wholeOf(inside);
    uint corner = gl_SubgroupInvocationID & 3u;
    CellSum sum = noCells();
    addCell(baked, inside, lowest, corner, 9u, sum);
    addCell(baked, inside, lowest, corner + 4u, 9u, sum);
    vec3 radiance[9];
    for (uint i = 0u; i < 9u; ++i) {
        radiance[i] = sum.radiance[i] + subgroupQuadSwapHorizontal(sum.radiance[i]);
        radiance[i] += subgroupQuadSwapVertical(radiance[i]);
    }
    float openness = sum.openness + subgroupQuadSwapHorizontal(sum.openness), outside = shareOutside(baked, place);
    openness += subgroupQuadSwapVertical(openness);
    vec3 irradiance = weightOfCells(openness, outside) * irradianceOfSh3(radiance, normal);
    // A loop that goes round for nobody is what spares CPU devices the work.
    uint rounds = outside > 0.0 ? 1u : 0u;
    for (uint i = 0u; i < rounds; ++i) {
        for (uint j = 0u; j < 9u; ++j)
            radiance[j] = baked.outside[j];
        irradiance += weightOfEnvironment(openness, outside) * irradianceOfSh3(radiance, normal);
    }
    return irradiance;
}

#endif
