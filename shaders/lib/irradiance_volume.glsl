// The light that comes in at a place, from the cells about it that are open, and beyond them from the environment. Needs shared/frame.h.
#ifndef LIB_IRRADIANCE_VOLUME_GLSL
#define LIB_IRRADIANCE_VOLUME_GLSL

#include "lib/float21.glsl"
#include "lib/quad.glsl"
#include "lib/sh.glsl"
#include "lib/tint.glsl"
#include "lib/whole.glsl"
#include "shared/prt.h"

// Of CellBlocks, both words at once: CPU devices gather them as fast as one.
layout(buffer_reference, scalar) readonly buffer Cells { uint64_t words[]; };

const uint kCellWords = kLocalShCoefficients + 3u;

// In cells from the first one.
vec3 placeInVolume(BakedLight baked, vec3 positionWorld) { return (positionWorld - baked.origin) * baked.cellsPerMetre; }

// 0 inside the outermost cells, 1 from one cell beyond them on: there the environment shines as it is.
float shareOutside(BakedLight baked, vec3 place)
{
    vec3 beyond = max(-place, place - vec3(baked.lastCell)) - 0.5;
    return clamp(max(beyond.x, max(beyond.y, beyond.z)), 0.0, 1.0);
}

// Sums over the cells about a place, of what is in a CellBlock.
struct CellSum
{
    vec3 values[kCellWords];
    float openness;
};

CellSum noCells()
{
    CellSum sum;
    for (uint i = 0u; i < kCellWords; ++i)
        sum.values[i] = vec3(0.0);
    sum.openness = 0.0;
    return sum;
}

// One of the cells about a place.
struct Corner
{
    uint firstWord;
    float weight; // trilinear
};

// Bits of `corner` say on which side of the lowest cell about `place` it lies.
Corner cornerAt(BakedLight baked, vec3 place, ivec3 lowest, uint corner)
{
    ivec3 cell = lowest + ivec3(corner & 1u, corner >> 1u & 1u, corner >> 2u), at = min(cell, baked.lastCell);
    vec3 share = 1.0 - abs(vec3(cell) - place);
    return Corner(kCellWords * uint((at.z * (baked.lastCell.y + 1) + at.y) * (baked.lastCell.x + 1) + at.x), share.x * share.y * share.z);
}

// So many values from `first` on; with value 0 comes the openness.
void addValues(BakedLight baked, Corner corner, uint first, uint count, inout CellSum sum)
{
    Cells cells = Cells(baked.cells);
    for (uint i = first; i < first + count; ++i) {
        uvec2 words = unpackUint2x32(cells.words[corner.firstWord + i]);
        sum.values[i] += corner.weight * unpackFloats21(words);
        sum.openness += i == 0u ? corner.weight * float(words.y & kCellIsOpen) : 0.0;
    }
}

// What sums over cells are to be multiplied by, of that openness. Where nothing is open, nothing was added: what lies within walls is dark.
float weightOfCells(float openness, float outside) { return (1.0 - outside) / max(openness * (1.0 - outside) + outside, 1.0e-6); }

// And the environment.
float weightOfEnvironment(float openness, float outside) { return outside / max(openness * (1.0 - outside) + outside, 1.0e-6); }

// The radiance that comes in, five bands, W/(m^2 sr).
void localRadiance(BakedLight baked, vec3 positionWorld, out vec3 radiance[kLocalShCoefficients])
{
    vec3 place = placeInVolume(baked, positionWorld), inside = clamp(place, vec3(0.0), vec3(baked.lastCell));
    ivec3 lowest = wholeOf(inside);
    CellSum sum = noCells();
    for (uint corner = 0u; corner < 8u; ++corner)
        addValues(baked, cornerAt(baked, inside, lowest, corner), 0u, kLocalShCoefficients, sum);
    float outside = shareOutside(baked, place);
    float whole = weightOfCells(sum.openness, outside), beyond = weightOfEnvironment(sum.openness, outside);
    for (uint i = 0u; i < kLocalShCoefficients; ++i)
        radiance[i] = whole * sum.values[i] + beyond * baked.outside[i];
}

// The irradiance of level surfaces there, of one that faces up and of one that faces down, W/m^2.
void irradianceAboveAndBelow(BakedLight baked, vec3 positionWorld, out vec3 above, out vec3 below)
{
    vec3 radiance[kLocalShCoefficients];
    localRadiance(baked, positionWorld, radiance);
    above = irradianceOfSh5(radiance, vec3(0.0, 1.0, 0.0));
    below = irradianceOfSh5(radiance, vec3(0.0, -1.0, 0.0));
}

// Of a surface that faces `normal`, by the values for it: three bands by colour, and the fifth, which is small, as that of the first.
vec3 irradianceOfCells(CellSum sum, vec3 normal)
{
    float y[25];
    shBasis5(normal, y);
    vec3 irradiance = vec3(0.0);
    float fifth = 0.0;
    for (uint i = 0u; i < 9u; ++i) {
        irradiance += cosineLobe(i) * y[i] * sum.values[i];
        fifth += cosineLobe(kFifthBand) * y[kFifthBand + i] * sum.values[kLocalShCoefficients + i / 3u][i % 3u];
    }
    vec3 mean = max(sum.values[0], vec3(0.0)); // which tells no colour where it is nothing
    return irradiance + mean * (fifth / max(sumOf(mean), 1.0e-30));
}

// The irradiance of a surface there that faces `normal`, W/m^2, in the middle of a quad's fragments, by all four: each adds two cells. What
// comes in changes little from pixel to pixel, and look-ups cost CPU devices most.
vec3 localIrradianceOfQuad(BakedLight baked, vec3 positionWorld, vec3 normal, bool isHelper)
{
    vec3 place = meanOverQuad(placeInVolume(baked, positionWorld), isHelper), inside = clamp(place, vec3(0.0), vec3(baked.lastCell));
    ivec3 lowest = wholeOf(inside);
    CellSum sum = noCells();
    for (uint side = 0u; side < 8u; side += 4u) {
        Corner corner = cornerAt(baked, inside, lowest, (gl_SubgroupInvocationID & 3u) + side);
        addValues(baked, corner, 0u, 9u, sum);
        addValues(baked, corner, kLocalShCoefficients, 3u, sum);
    }
    for (uint i = 0u; i < kCellWords; ++i)
        addOverQuad(sum.values[i]);
    addOverQuad(sum.openness);
    float outside = shareOutside(baked, place);
    vec3 irradiance = weightOfCells(sum.openness, outside) * irradianceOfCells(sum, normal);
    // A loop that goes round for nobody is what spares CPU devices the work.
    uint rounds = outside > 0.0 ? 1u : 0u;
    for (uint i = 0u; i < rounds; ++i)
        irradiance += weightOfEnvironment(sum.openness, outside) * irradianceOfSh5(baked.outside, normal);
    return irradiance;
}

#endif
