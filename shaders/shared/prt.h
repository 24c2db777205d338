// Baked light: what the passes that light it anew take, and what they make.
#ifndef SHARED_PRT_H
#define SHARED_PRT_H

const uint kIrradianceWords = 14u; // of a cell: all that a surface's irradiance takes
const uint kCellWords = 25u;

// The radiance that comes in at a cell of the irradiance volume, W/(m^2 sr), in halves [coefficient * 3 + channel]: three bands, then
// whether the cell is open, 1 or 0, then the fourth band, and one that is unused. Closed cells are dark.
struct CellBlock
{
    uint halves[kCellWords];
};

struct PrtRelight
{
    uint64_t transfers; // halves, two texels a word: [coefficient * 3 + channel][y][x]
    uint64_t texels; // uvec2[y][x], written: irradiance, W/m^2, as in lib/float21.glsl
    uint frame; // slot of a FrameBlock
    uint coefficientCount;
    uvec2 wordCount; // of a plane: half as many as texels in a row, and rows
};

struct VolumeRelight
{
    uint64_t matrices; // halves, two a word: [(row * coefficientCount + column) * 3 + channel][cell]
    uint64_t cells; // CellBlock[cellCount], whose radiance is written
    uint frame; // slot of a FrameBlock
    uint coefficientCount;
    uint cellCount;
};

#endif
