// Which occluders can stand between a tile of pixels and an area light (KT et al. 2021, GetBetween, once a tile): those that meet the hull of
// the spheres about the tile's surfaces and about the light. One thread a tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/area.h"
#include "lib/surface.glsl"
#include "lib/shaft.glsl"

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Owners { uint light[]; };
layout(buffer_reference, scalar) readonly buffer Bodies { BodyBlock body[]; };
layout(buffer_reference, scalar) writeonly buffer Tiles { AreaTileBlock block[]; };
layout(push_constant, scalar) uniform Push { AreaTiles pc; };

layout(local_size_x = 64) in;

struct TileBounds
{
    vec3 lowest;
    vec3 highest;
};

TileBounds boundsOf(uvec2 tile)
{
    uvec2 extent = uvec2(textureSize(sampledImages[pc.depth], 0));
    uvec2 first = tile * kAreaTileSize, end = min(first + kAreaTileSize, extent);
    TileBounds bounds = TileBounds(vec3(1.0e30), vec3(-1.0e30));
    for (uint y = first.y; y < end.y; ++y)
        for (uint x = first.x; x < end.x; ++x) {
            float depth = texelFetch(sampledImages[pc.depth], ivec2(x, y), 0).x;
            if (depth <= 0.0)
                continue;
            vec3 position = worldPosition(frameBlock, vec2(x, y) + 0.5, depth);
            bounds.lowest = min(bounds.lowest, position);
            bounds.highest = max(bounds.highest, position);
        }
    return bounds;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= pc.tileCount)
        return;
    AreaBlock area = Areas(pc.area).block;
    TileBounds bounds = boundsOf(uvec2(index % area.tilesAcross, index / area.tilesAcross));
    bool hasSurface = bounds.lowest.x <= bounds.highest.x;
    vec3 centre = 0.5 * (bounds.lowest + bounds.highest);
    // Past what points are moved off their surface by (lib/surface.glsl).
    float radius = 0.5 * distance(bounds.lowest, bounds.highest) * 1.00001 + 8.0 * positionError(bounds.highest, frameBlock.eye);
    for (uint light = 0u; light < area.lightCount; ++light) {
        BodyBlock source = Bodies(area.arrays.bodies).body[Lights(area.lights).block[light].body];
        uint at = index * area.lightCount + light, count = 0u;
        for (uint i = 0u; hasSurface && i < area.occluderCount; ++i) {
            BodyBlock occluder = Bodies(area.arrays.bodies).body[area.firstOccluder + i];
            if (Owners(area.owners).light[i] == Lights(area.lights).block[light].light ||
                !meetsShaft(centre, radius, source.centre, source.radius, occluder.centre, occluder.radius))
                continue;
            if (count < kAreaTileOccluders)
                Tiles(pc.tiles).block[at].occluders[count] = area.firstOccluder + i;
            ++count;
        }
        Tiles(pc.tiles).block[at].count = count;
    }
}
