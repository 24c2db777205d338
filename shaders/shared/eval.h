// Cases with known answers, run through the functions of shaders/lib (engine/app/eval.h).
#ifndef SHARED_EVAL_H
#define SHARED_EVAL_H

struct ConeCase
{
    vec3 position;
    vec3 normal;
    uint firstSphere;
    uint sphereCount;
    uint firstProbe;
    uint probeCount;
};

const uint kConeNone = 0u; // the sphere is behind
const uint kConePart = 1u;
const uint kConeAll = 2u;

// The cone of one sphere.
struct ConeBlock
{
    vec3 axis;
    float chord;
    float halfAngle;
    float height;
    float mergedHeight; // of all cones that this one keeps
    uint kind;
    uint keeper; // index of the sphere whose cone absorbs this one; its own where none does
};

struct ProbeBlock
{
    vec3 direction;
    uint isTraced; // written
    float far; // how far it must go; written
};

struct EvalCones
{
    uint64_t cases; // ConeCase[caseCount]
    uint64_t spheres; // SphereBlock[]
    uint64_t cones; // ConeBlock[], one a sphere, written
    uint64_t probes; // ProbeBlock[]
    uint caseCount;
};

struct IrradianceCase
{
    vec3 position;
    vec3 normal;
    vec3 centre;
    float radius;
    float radianceSh[9];
};

struct EvalIrradiance
{
    uint64_t cases; // IrradianceCase[caseCount]
    uint64_t samples; // vec4[sampleCount], local directions
    uint64_t occluded; // float[caseCount], written
    uint caseCount;
    uint sampleCount;
};

struct AreaCase
{
    vec3 position;
    vec3 normal;
    vec3 tangent; // the bitangent is cross(normal, tangent)
    vec3 lobe[3]; // rows of M^-1, which takes (tangent, bitangent, normal) to the lobe's space
    uint light; // into the bodies
    uint firstOccluder;
    uint occluderCount;
};

struct AreaAnswer
{
    float unoccluded;
    float shadowed;
    uint fallbacks;
};

const uint kAreaScratchBytes = 147456u; // 66 polygons of 64 corners, and 1536 edges of 52 bytes

struct EvalArea
{
    BodyArrays arrays;
    uint64_t cases; // AreaCase[caseCount]
    uint64_t answers; // AreaAnswer[caseCount], written
    uint64_t scratch; // kAreaScratchBytes a case, or null where threads have room of their own
    uint caseCount;
    uint mostPieces;
};

#endif
