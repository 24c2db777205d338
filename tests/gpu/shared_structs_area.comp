// The structs of area lights, as shared_structs.comp does those of others.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/area.h"
#include "shared/eval.h"
#include "shared/field.h"
#include "shared/light_share.h"
#include "shared/probe.h"
#include "shared/scene.h"
#include "../tests/gpu/shared_structs.glsl"

#if defined(BODY_BLOCK)

#define Block BodyBlock
void echo(BodyBlock b)
{
    put(b.centre);
    put(b.radius);
    put(b.firstVertex);
    put(b.vertexCount);
    put(b.firstFace);
    put(b.faceCount);
    put(b.firstEdge);
    put(b.edgeCount);
    put(b.flags);
    put(b.margin);
}

#elif defined(FACE_BLOCK)

#define Block FaceBlock
void echo(FaceBlock b)
{
    put(b.normal);
    put(b.firstCorner);
    put(b.cornerCount);
}

#elif defined(EDGE_BLOCK)

#define Block EdgeBlock
void echo(EdgeBlock b)
{
    put(b.vertices);
    put(b.faces);
}

#elif defined(BODY_ARRAYS) || defined(EVAL_AREA)

void echoArrays(BodyArrays b)
{
    put(b.bodies);
    put(b.vertices);
    put(b.faces);
    put(b.corners);
    put(b.edges);
}
#ifdef BODY_ARRAYS
#define Block BodyArrays
void echo(BodyArrays b) { echoArrays(b); }
#else
#define Block EvalArea
void echo(EvalArea b)
{
    echoArrays(b.arrays);
    put(b.cases);
    put(b.answers);
    put(b.scratch);
    put(b.caseCount);
    put(b.mostPieces);
}
#endif

#elif defined(AREA_CASE)

#define Block AreaCase
void echo(AreaCase b)
{
    put(b.position);
    put(b.normal);
    put(b.tangent);
    for (int i = 0; i < 3; ++i)
        put(b.lobe[i]);
    put(b.light);
    put(b.firstOccluder);
    put(b.occluderCount);
}

#elif defined(AREA_ANSWER)

#define Block AreaAnswer
void echo(AreaAnswer b)
{
    put(b.unoccluded);
    put(b.shadowed);
    put(b.fallbacks);
}

#elif defined(AREA_LIGHT_BLOCK)

#define Block AreaLightBlock
void echo(AreaLightBlock b)
{
    put(b.radiance);
    put(b.body);
    put(b.light);
}

#elif defined(AREA_TILE_BLOCK)

#define Block AreaTileBlock
void echo(AreaTileBlock b)
{
    put(b.count);
    for (int i = 0; i < b.occluders.length(); ++i)
        put(b.occluders[i]);
}

#elif defined(AREA_BLOCK)

#define Block AreaBlock
void echo(AreaBlock b)
{
    put(b.arrays.bodies);
    put(b.arrays.vertices);
    put(b.arrays.faces);
    put(b.arrays.corners);
    put(b.arrays.edges);
    put(b.fields);
    put(b.lights);
    put(b.owners);
    put(b.firstOccluder);
    put(b.occluderCount);
    put(b.lightCount);
    put(b.tilesAcross);
}

#elif defined(AREA_TILES)

#define Block AreaTiles
void echo(AreaTiles b)
{
    put(b.area);
    put(b.tiles);
    put(b.frame);
    put(b.depth);
    put(b.tileCount);
}

#elif defined(AREA_PROBE)

#define Block AreaProbe
void echo(AreaProbe b)
{
    put(b.area);
    put(b.lines);
    put(b.scratch);
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.albedo);
    put(b.mostPlanes);
    put(b.pixel.x);
    put(b.pixel.y);
}

#elif defined(PROBE_LINE)

#define Block ProbeLine
void echo(ProbeLine b)
{
    put(b.start);
    put(b.end);
    put(b.kind);
}

#elif defined(AREA_SHADE)

#define Block AreaShade
void echo(AreaShade b)
{
    put(b.area);
    put(b.tiles);
    put(b.counters);
    put(b.scene);
    put(b.shares);
    put(b.seenPastFields);
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.albedo);
    put(b.material);
    put(b.ltcMatrix);
    put(b.ltcAmplitude);
    put(b.diffuse);
    put(b.specular);
    put(b.diffuseBefore);
    put(b.specularBefore);
    put(b.firstLight);
    put(b.endLight);
    put(b.mostPieces);
    put(b.mostPlanes);
    put(b.rays);
    put(b.frameIndex);
    put(b.pixelScale);
}

#elif defined(AREA_UPSAMPLE)

#define Block AreaUpsample
void echo(AreaUpsample b)
{
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.diffuseLit);
    put(b.specularLit);
    put(b.diffuse);
    put(b.specular);
    put(b.pixelScale);
}

#elif defined(LIGHT_BODY_DRAW)

#define Block LightBodyDraw
void echo(LightBodyDraw b)
{
    for (int i = 0; i < b.worldFromLocal.length(); ++i)
        put(b.worldFromLocal[i]);
    put(b.positions);
    put(b.normals);
    put(b.radiance);
    put(b.exposure);
    put(b.frame);
    put(b.isTwoSided);
}


#elif defined(RATIO_SAMPLE)

#define Block RatioSample
void echo(RatioSample b)
{
    put(b.seen);
    put(b.whole);
    put(b.halfPenumbra);
}

#elif defined(RATIO_TRACE)

#define Block RatioTrace
void echo(RatioTrace b)
{
    put(b.area);
    put(b.scene);
    put(b.samples);
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.albedo);
    put(b.material);
    put(b.firstLight);
    put(b.endLight);
    put(b.rays);
    put(b.pixelScale);
}

#elif defined(RATIO_DENOISE)

#define Block RatioDenoise
void echo(RatioDenoise b)
{
    put(b.samples);
    put(b.denoised);
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.lightCount);
    put(b.spacing);
    put(b.pixelScale);
}

#elif defined(SHADOW_RAY)

#define Block ShadowRay
void echo(ShadowRay b)
{
    put(b.halfPenumbra);
    put(b.blocker);
}

#elif defined(PENUMBRA_TRACE)

#define Block PenumbraTrace
void echo(PenumbraTrace b)
{
    put(b.area);
    put(b.scene);
    put(b.rays);
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.firstLight);
    put(b.endLight);
    put(b.pixelScale);
}

#elif defined(PENUMBRA_SEARCH)

#define Block PenumbraSearch
void echo(PenumbraSearch b)
{
    put(b.area);
    put(b.rays);
    put(b.shares);
    put(b.frame);
    put(b.depth);
    put(b.firstLight);
    put(b.endLight);
    put(b.pixelScale);
}

#endif

layout(buffer_reference, scalar) readonly buffer Blocks { Block block[]; };

void main() { echo(Blocks(pc.inputs).block[1]); }
