#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "lib/half.glsl"
#include "shared/prt.h"

// The light that comes in at every cell of the irradiance volume: its matrix times the environment's light.
layout(local_size_x = 64) in; // a thread one or two rows of one cell's matrix; neighbours in space are neighbours in memory

layout(buffer_reference, scalar) readonly buffer Words { uint word[]; };
layout(buffer_reference, scalar) buffer Cells { CellBlock cell[]; };
layout(push_constant, scalar) uniform Push { VolumeRelight pc; };

const uint kRows = 16u, kLastOfThreeBands = 8u;

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
    return sum;
}

void main()
{
    // Two rows fill three words, and behind the last of three bands the cell's openness fills the second.
    uint cell = gl_GlobalInvocationID.x, pair = gl_GlobalInvocationID.y;
    bool isFourth = 2u * pair > kLastOfThreeBands;
    uint row = isFourth ? 2u * pair - 1u : 2u * pair, word = isFourth ? 3u * pair - 1u : 3u * pair;
    if (cell >= pc.cellCount)
        return;
    Cells cells = Cells(pc.cells);
    vec3 first = withinHalf(coefficient(row, cell));
    cells.cell[cell].halves[word] = packHalf2x16(first.rg);
    if (row != kLastOfThreeBands && row + 1u < kRows) {
        vec3 second = withinHalf(coefficient(row + 1u, cell));
        cells.cell[cell].halves[word + 1u] = packHalf2x16(vec2(first.b, second.r));
        cells.cell[cell].halves[word + 2u] = packHalf2x16(second.gb);
    } else {
        float beside = unpackHalf2x16(cells.cell[cell].halves[word + 1u]).y;
        cells.cell[cell].halves[word + 1u] = packHalf2x16(vec2(first.b, beside));
    }
}
