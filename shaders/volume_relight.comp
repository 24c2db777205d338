#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "lib/float21.glsl"
#include "lib/half.glsl"
#include "lib/tint.glsl"
#include "shared/prt.h"

// The light that comes in at every cell of the irradiance volume: its matrix times the environment's light.
layout(local_size_x = 64) in; // a thread a row of one cell's matrix, or three of its fifth band; neighbours in space are so in memory

layout(buffer_reference, scalar) readonly buffer Words { uint word[]; };
layout(buffer_reference, scalar) buffer Cells { CellBlock cell[]; };
layout(push_constant, scalar) uniform Push { VolumeRelight pc; };

float matrixValue(uint index) { return unpackHalf2x16(Words(pc.matrices).word[index >> 1u] >> 16u * (index & 1u)).x; }

vec3 coefficient(uint row, uint cell)
{
    uint index = row * pc.coefficientCount * 3u * pc.cellCount + cell;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < pc.coefficientCount; ++i) {
        vec3 radiance = frameBlock.radianceSh[i];
        for (int c = 0; c < 3; ++c, index += pc.cellCount)
            sum[c] += radiance[c] * matrixValue(index);
    }
    return withinHalf(sum);
}

void main()
{
    uint cell = gl_GlobalInvocationID.x, row = gl_GlobalInvocationID.y;
    if (cell >= pc.cellCount)
        return;
    Cells cells = Cells(pc.cells);
    if (row < kFifthBand) {
        uvec2 words = packFloats21(coefficient(row, cell));
        words.y |= row == 0u ? cells.cell[cell].radiance[0].y & kCellIsOpen : 0u;
        cells.cell[cell].radiance[row] = words;
        return;
    }
    uint three = row - kFifthBand;
    vec3 sums;
    for (uint i = 0u; i < 3u; ++i) {
        vec3 radiance = coefficient(kFifthBand + 3u * three + i, cell);
        cells.cell[cell].radiance[kFifthBand + 3u * three + i] = packFloats21(radiance);
        sums[i] = sumOf(radiance);
    }
    cells.cell[cell].fifthBand[three] = packFloats21(sums);
}
