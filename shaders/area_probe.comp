// What the closed form makes of one pixel, as lines to draw: the outlines of the lights, the silhouettes before them, and the pieces of the
// lights that are left, on the lights' planes. One thread, whose arrays lie in memory: drivers of GPUs refuse it that much of its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#define POLYGON_PLACES 20
#define POLYGON_CORNERS 64
#define SILHOUETTE_EDGES 512
#define SILHOUETTE_BODY_EDGES 64
#define FACE_WORDS 10
#define OUTLINE_CORNERS 52
#define LIGHT_VERTICES 192
#define AREA_OCCLUDERS 8
#define AREA_SIGNED 0 // pieces are what is seen
#define IN_SCRATCH
#define PIECES_ARE_TOLD
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
#include "lib/area.glsl"
#include "lib/frame.glsl"
#include "lib/hemisphere.glsl"
#include "lib/surface.glsl"
#include "shared/probe.h"

layout(buffer_reference, scalar) readonly buffer Areas { AreaBlock block; };
layout(buffer_reference, scalar) readonly buffer Lights { AreaLightBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Owners { uint light[]; };
layout(buffer_reference, scalar) buffer Lines
{
    uint count;
    ProbeLine line[];
};
layout(push_constant, scalar) uniform Push { AreaProbe pc; };

layout(local_size_x = 1) in;

vec3 point; // of the pixel's surface, off it
mat3 worldFromLobe;
CutPlane lightPlane; // of the face of the light that is looked at; of a solid one square to the way there
uint lineCount = 0u;

void addLine(vec3 start, vec3 end, uint kind)
{
    if (lineCount < kMostProbeLines)
        Lines(pc.lines).line[lineCount++] = ProbeLine(point + start, point + end, kind);
}

vec3 onLightPlane(vec3 direction)
{
    float towards = dot(lightPlane.normal, direction);
    return direction * (-lightPlane.offset / (abs(towards) > 1.0e-6 ? towards : 1.0e-6));
}

void tellPiece(int place)
{
    int base = place * POLYGON_CORNERS;
    for (int i = 0; i < cornerCounts[place]; ++i) {
        vec3 end = polygonCorners[base + (i + 1 < cornerCounts[place] ? i + 1 : 0)].xyz;
        addLine(onLightPlane(worldFromLobe * polygonCorners[base + i].xyz), onLightPlane(worldFromLobe * end), kProbePiece);
    }
}

void probe(AreaBlock area, uint index, vec3 normal, mat3 tangentSpace, bool isMoving)
{
    AreaLightBlock light = Lights(area.lights).block[index];
    BodyBlock body = Bodies(area.arrays.bodies).body[light.body];
    if (!beginLight(area.arrays, body, point))
        return;
    for (uint i = 0u; i < area.occluderCount; ++i) {
        BodyBlock blocker = occluderBefore(area.arrays, area.firstOccluder + i, isMoving);
        if (Owners(area.owners).light[i] != light.light && mayHide(blocker, point))
            addOccluder(area.arrays, body, blocker, point);
    }
    vec3 to = body.centre - point;
    lightPlane = (body.flags & kBodyPlanar) != 0u ? planeOfFace(area.arrays, body, bodyFace(area.arrays, body, 0u), point)
                                                  : CutPlane(-normalize(to), length(to));
    for (int i = 0; i < outlineCount; ++i) {
        vec3 end = outline[i + 1 < outlineCount ? i + 1 : 0];
        addLine(onLightPlane(outline[i]), onLightPlane(end), kProbeLight);
    }
    for (int i = 0; i < edgeCount; ++i)
        addLine(edgeStarts[i], edgeStarts[i] + edgeSpans[i], kProbeSilhouette);
    areaShare(tangentSpace, normal, kMostProbeLines);
}

void main()
{
    scratch = Scratch(pc.scratch);
    mostPlanes = pc.mostPlanes;
    float depth = texelFetch(sampledImages[pc.depth], pc.pixel, 0).x;
    if (depth > 0.0) {
        vec4 octahedral = texelFetch(sampledImages[pc.normals], pc.pixel, 0);
        vec3 normal = unitFromOctahedral(octahedral.zw);
        point = rayOrigin(worldPosition(frameBlock, vec2(pc.pixel) + 0.5, depth), unitFromOctahedral(octahedral.xy), frameBlock.eye);
        worldFromLobe = tangentFrame(normal);
        AreaBlock area = Areas(pc.area).block;
        bool isMoving = texelFetch(sampledImages[pc.albedo], pc.pixel, 0).a > 0.5;
        for (uint i = 0u; i < area.lightCount; ++i)
            probe(area, i, normal, transpose(worldFromLobe), isMoving);
    }
    Lines(pc.lines).count = lineCount;
}
