// What the closed form makes of one pixel, as lines in the world.
#ifndef SHARED_PROBE_H
#define SHARED_PROBE_H

const uint kProbeLight = 0u; // of the outline of a light
const uint kProbeSilhouette = 1u; // of what is before it
const uint kProbePiece = 2u; // of what is left of the light
const uint kMostProbeLines = 1024u;
const uint kProbeScratchBytes = 47104u;

struct ProbeLine
{
    vec3 start; // world
    vec3 end;
    uint kind; // kProbe...
};

struct AreaProbe
{
    uint64_t area; // AreaBlock
    uint64_t lines; // uint, how many; ProbeLine[kMostProbeLines], written
    uint64_t scratch; // kProbeScratchBytes
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint albedo;
    int mostPlanes;
    ivec2 pixel;
};

#endif
