// Shares of area lights behind convex bodies, for cases of golden/README.md: one thread a case, with room for the hardest of them.
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
    if (index < pc.caseCount)
        Answers(pc.answers).block[index] = answerOf(Cases(pc.cases).block[index]);
}
