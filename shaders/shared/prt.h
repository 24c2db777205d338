// Baked light: what the passes that light it anew take, and what they make. Needs shared/frame.h.
#ifndef SHARED_PRT_H
#define SHARED_PRT_H

// The radiance that comes in at a cell of the irradiance volume, W/(m^2 sr), as in lib/float21.glsl. Closed cells are dark.
const uint kFifthBand = 16u; // its first coefficient; the nine of it are written by threes
struct CellBlock
{
    uvec2 radiance[kLocalShCoefficients]; // the lowest bit of the first's second word: whether the cell is open
    uvec2 fifthBand[3]; // three each of its coefficients, each the sum of its channels: all that surfaces need of it, in a third of the room
};

const uint kCellIsOpen = 1u;

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
