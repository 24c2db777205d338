// Which cell of the mask table holds a cone. The host fills the table by the same function (engine/render/shadow/mask_table.cpp).
#ifndef LIB_MASK_TABLE_GLSL
#define LIB_MASK_TABLE_GLSL

#include "lib/octahedral.glsl"

// `axis` in the sample frame, unit; `sine` of the half angle, which is at most a right one.
uint maskCell(vec3 axis, float sine)
{
    vec2 square = octahedralFromUnit(axis) * 0.5 + 0.5;
    uvec2 cell = min(uvec2(max(square, vec2(0.0)) * float(kMaskAxisCells)), uvec2(kMaskAxisCells - 1u));
    uint angle = min(uint(max(sine, 0.0) * float(kMaskAngleCells)), kMaskAngleCells - 1u);
    return (angle * kMaskAxisCells + cell.y) * kMaskAxisCells + cell.x;
}

#endif
