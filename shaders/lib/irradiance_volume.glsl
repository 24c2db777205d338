// The light that comes in at a place, from the cells about it that are open. Needs shared/frame.h.
#ifndef LIB_IRRADIANCE_VOLUME_GLSL
#define LIB_IRRADIANCE_VOLUME_GLSL

#extension GL_KHR_shader_subgroup_quad : require
#include "shared/prt.h"

layout(buffer_reference, scalar) readonly buffer Cells { CellBlock cell[]; };

const float kOffSurface = 0.3; // cells along the normal, where those behind the surface count for less
const uint kOpenness = 2u * kCellWords - 1u; // of a cell's values

// In cells from the first one.
vec3 placeInVolume(BakedLight baked, vec3 positionWorld, vec3 normal)
{
    vec3 place = (positionWorld - baked.origin) * baked.cellsPerMetre + kOffSurface * normal;
    return clamp(place, vec3(0.0), vec3(baked.lastCell));
}

// Adds the values of a cell about `place` with its trilinear weight; bits of `corner` say on which side it lies.
void addCell(BakedLight baked, vec3 place, uint corner, inout float values[2 * kCellWords])
{
    ivec3 side = ivec3(corner & 1u, corner >> 1u & 1u, corner >> 2u);
    ivec3 lowest = ivec3(place), at = min(lowest + side, baked.lastCell);
    vec3 share = 1.0 - abs(vec3(lowest + side) - place);
    float weight = share.x * share.y * share.z;
    CellBlock cell = Cells(baked.cells).cell[(at.z * (baked.lastCell.y + 1) + at.y) * (baked.lastCell.x + 1) + at.x];
    for (uint i = 0u; i < kCellWords; ++i) {
        vec2 pair = unpackHalf2x16(cell.halves[i]);
        values[2u * i] += weight * pair.x;
        values[2u * i + 1u] += weight * pair.y;
    }
}

void spread(float values[2 * kCellWords], out vec3 radiance[9])
{
    float whole = 1.0 / max(values[kOpenness], 1.0e-6); // where nothing is open, nothing was added
    for (int j = 0; j < 9; ++j)
        radiance[j] = vec3(values[3 * j], values[3 * j + 1], values[3 * j + 2]) * whole;
}

// Three bands, W/(m^2 sr); zero where all cells about the place are closed.
void localRadiance(BakedLight baked, vec3 positionWorld, vec3 normal, out vec3 radiance[9])
{
    vec3 place = placeInVolume(baked, positionWorld, normal);
    float values[2 * kCellWords];
    for (uint i = 0u; i < 2u * kCellWords; ++i)
        values[i] = 0.0;
    for (uint corner = 0u; corner < 8u; ++corner)
        addCell(baked, place, corner, values);
    spread(values, radiance);
}

// The same at the place of a quad's first fragment, by all four: each adds two cells. What comes in changes little from pixel to pixel,
// and look-ups cost CPU devices most. Helper invocations take part, discarded ones may not.
void localRadianceOfQuad(BakedLight baked, vec3 positionWorld, vec3 normal, out vec3 radiance[9])
{
    vec3 place = subgroupQuadBroadcast(placeInVolume(baked, positionWorld, normal), 0u);
    float values[2 * kCellWords];
    for (uint i = 0u; i < 2u * kCellWords; ++i)
        values[i] = 0.0;
    uint corner = gl_SubgroupInvocationID & 3u;
    addCell(baked, place, corner, values);
    addCell(baked, place, corner + 4u, values);
    for (uint i = 0u; i < 2u * kCellWords; ++i) {
        values[i] += subgroupQuadSwapHorizontal(values[i]);
        values[i] += subgroupQuadSwapVertical(values[i]);
    }
    spread(values, radiance);
}

#endif
