// Baked light: what the passes that light it anew take, and what they make.
#ifndef SHARED_PRT_H
#define SHARED_PRT_H

const uint kCellWords = 14u;

// The radiance that comes in at a cell of the irradiance volume, W/(m^2 sr): 27 halves, [coefficient * 3 + channel], then whether the cell
// is open, 1 or 0. Closed cells are dark.
struct CellBlock
{
    uint halves[kCellWords];
};

struct PrtRelight
{
    uint64_t transfers; // halves, two texels a word: [coefficient * 3 + channel][y][x]
    uint64_t texels; // uvec2[y][x], written: irradiance, W/m^2, three halves
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
