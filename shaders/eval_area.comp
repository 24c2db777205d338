// Shares of area lights behind convex bodies, for cases of golden/README.md: one thread a case, with room for the hardest of them. Variant
// IN_SCRATCH: in memory, as drivers of GPUs refuse threads that much of their own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#define POLYGON_PLACES 66
#define POLYGON_CORNERS 64
#define SILHOUETTE_EDGES 1536
#define SILHOUETTE_BODY_EDGES 128
#define FACE_WORDS 10
#define OUTLINE_CORNERS 62
#define LIGHT_VERTICES 64
#define AREA_OCCLUDERS 400
#define AREA_SIGNED 2
#ifdef IN_SCRATCH
layout(buffer_reference, scalar) buffer Scratch
{
    vec4 polygonCorners[POLYGON_PLACES * POLYGON_CORNERS];
    vec4 edgePlanes[SILHOUETTE_EDGES];
    vec3 edgeStarts[SILHOUETTE_EDGES];
    vec3 edgeSpans[SILHOUETTE_EDGES];
    vec3 lobePlanes[SILHOUETTE_EDGES];
};
Scratch scratch;
#define polygonCorners scratch.polygonCorners
#define edgePlanes scratch.edgePlanes
#define edgeStarts scratch.edgeStarts
#define edgeSpans scratch.edgeSpans
#define lobePlanes scratch.lobePlanes
#endif
#include "lib/area.glsl"
#include "shared/eval.h"

layout(buffer_reference, scalar) readonly buffer Cases { AreaCase block[]; };
layout(buffer_reference, scalar) writeonly buffer Answers { AreaAnswer block[]; };
layout(push_constant, scalar) uniform Push { EvalArea pc; };

layout(local_size_x = 64) in;

AreaAnswer answerOf(AreaCase at)
{
    Bodies bodies = Bodies(pc.arrays.bodies);
    BodyBlock light = bodies.body[at.light];
    if (!beginLight(pc.arrays, light, at.position))
        return AreaAnswer(0.0, 0.0, isLightLost ? 1u : 0u);
    for (uint i = 0u; i < at.occluderCount; ++i)
        addOccluder(pc.arrays, light, bodies.body[at.firstOccluder + i], at.position);
    mat3 tangentSpace = transpose(mat3(at.tangent, cross(at.normal, at.tangent), at.normal));
    AreaShare share = areaShare(transpose(mat3(at.lobe[0], at.lobe[1], at.lobe[2])) * tangentSpace, at.normal, pc.mostPieces);
    return AreaAnswer(share.unoccluded, share.visible, share.fallbacks + (isOccluderLost || isLightLost ? 1u : 0u));
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
#ifdef IN_SCRATCH
    scratch = Scratch(pc.scratch + uint64_t(index) * kAreaScratchBytes);
#endif
    if (index < pc.caseCount)
        Answers(pc.answers).block[index] = answerOf(Cases(pc.cases).block[index]);
}
