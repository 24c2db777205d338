// Environment light that moving objects hide.
#ifndef SHARED_OCCLUSION_H
#define SHARED_OCCLUSION_H

const uint kCullNone = 0u;
const uint kCullDirection = 1u;
const uint kCullLength = 2u;
const uint kCullBones = 3u;

const uint kMaskStatic = 1u;
const uint kMaskDynamic = 2u;
const uint kMaskAll = 3u; // triangles
const uint kMaskFields = 4u; // boxes about groups of steps

// Pixels that trace their rays together.
const uint kTraceGroupWidth = 16u;
const uint kTraceGroupHeight = 8u;

// One character, in the world.
struct BlockerBlock
{
    vec3 centre;
    float radius;
    uint firstCapsule;
    uint capsuleCount;
};

// A character's bounds on their way from its own space to the world.
struct BlockerSource
{
    mat4 worldFromLocal;
    uint64_t sphere; // SphereBlock
    uint64_t capsules; // CapsuleBlock[capsuleCount]
    uint firstCapsule;
    uint capsuleCount;
    float scale; // the greatest of worldFromLocal
    uint padding;
};

struct BlockerDispatch
{
    uint64_t sources; // BlockerSource[]
    uint64_t blockers; // BlockerBlock[], written
    uint64_t capsules; // CapsuleBlock[], written
};

const uint kGroundRings = 3u;
const uint kGroundRingPoints = 32u; // of a character's ground, where the shadow is found

// The level ground below a character, and what it does not send up because the character shadows it.
struct GroundBlock
{
    vec3 centre; // world
    float radius; // of the character's sphere
    float height; // of the sphere's centre above the ground
    vec3 missed[kGroundRings]; // from the feet outwards, each ring three times as wide as the one in it; W/(m^2 sr)
};

struct GroundDispatch
{
    uint64_t scene; // top-level acceleration structure, or BvhScene
    uint64_t blockers; // BlockerBlock[]
    uint64_t grounds; // GroundBlock[], written
    uint frame; // slot of a FrameBlock
    uint padding;
};

struct OcclusionTrace
{
    uint64_t scene; // top-level acceleration structure, or BvhScene
    uint64_t samples; // vec3[sampleCount], local directions
    uint64_t counters; // CounterBlock
    uint64_t blockers; // BlockerBlock[blockerCount]
    uint64_t capsules; // CapsuleBlock[]
    uint64_t fields; // FieldsBlock, where there are any
    uint64_t grounds; // GroundBlock[groundCount], in the light of the irradiance volume alone
    uint frame; // slots: FrameBlock,
    uint depth;
    uint normals;
    uint occluded; // written: a traced pixel, or by the reference W/m^2
    uint isFiltered; // distances to what hides light are asked for
    uint sampleCount;
    uint blockerCount;
    uint groundCount;
    float tolerance; // share of the unshadowed irradiance a cone may at most hide to be left out
    float pixelScale; // of the occlusion image to the G-buffer: 1, 2, 4
    uint frameIndex; // of the reference's accumulation
    uint padding;
};

// Images of traced pixels are those of lib/traced.glsl.
struct OcclusionFilter
{
    uint frame; // slot of a FrameBlock
    uint traced;
    uint filtered;
    int radius; // traced pixels
    float pixelScale;
    uvec2 lastPixel; // of the G-buffer
};

const uint kNothingTraced = 0xffffffffu;

struct ReferenceAccumulate
{
    uint now; // written
    uint before;
    uint traced; // kNothingTraced: the mean stays
    uint frameCount; // frames summed in `before`
};

#endif
