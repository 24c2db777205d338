// Signed distance fields: solids put together step by step.
#ifndef SHARED_FIELD_H
#define SHARED_FIELD_H

// Shapes that share a formula, in their own space: the centre at the origin, the axis along Y.
const uint kFieldSegment = 0u; // sphere, capsule
const uint kFieldBox = 1u; // box, rounded box
const uint kFieldTorus = 2u;
const uint kFieldCone = 3u; // cylinder, cone, frustum
const uint kFieldPlane = 4u;

const uint kFieldUnion = 0u;
const uint kFieldSubtract = 1u;
const uint kFieldIntersect = 2u;
const uint kFieldSmoothUnion = 3u;

// The first step of a field: what the steps before it made stands beside it.
const uint kFieldBegins = 1u;

// A step: a shape, and what becomes of the distance so far.
struct FieldStepBlock
{
    vec4 localFromWorld[3]; // rows
    vec4 size; // segment: half length, radius; box: half edges, rounding; torus: major, minor; cone: radius below, above, half height
    float scale; // distances in the world are at least that many times local ones
    float blend; // metres, of a smooth union
    uint shape;
    uint operation;
    uint flags;
};

// Steps in a row of one field that matter only near them: the distance of each is at least slope * |p - centre| - reach, and, outside of a box,
// slope * its distance. None of them changes a distance that is less than that, inside a solid as outside, but for how far it melts.
struct FieldGroupBlock
{
    vec3 centre;
    float reach; // metres; how far smooth unions melt is added
    vec3 halfEdges; // of the box about the centre, metres
    float melt; // metres, that these steps and later ones of the field blend over at most
    float slope;
    uint firstStep;
    uint endStep;
    uint field; // that they are of, counted from 0
    uint takesAway; // 1 where one of them does, and so changes distances inside solids
};

// Fields that are met together: groups in a row, and their steps.
struct FieldsBlock
{
    uint64_t steps; // FieldStepBlock[]
    uint64_t groups; // FieldGroupBlock[groupCount]
    uint64_t surfaces; // FieldSurfaceBlock[], one a step
    uvec2 skipped; // groups that are not looked at: of 64 bits the (g % 64)th for the g-th of them
    uint groupCount;
    uint takesAway; // 1 where one of the groups does
};

// What light does on a step's surface.
struct FieldSurfaceBlock
{
    vec3 albedo; // linear
    float roughness;
    float metallic;
    float specular;
};

const uint kFieldTileSize = 16u; // pixels along each side of a square that is drawn
const float kFieldFarthestSeen = 1.0e4; // metres from the eye, of what has no end

// What the camera sees of fields: push constants.
struct FieldDraw
{
    FieldsBlock fields;
    uint frame; // slot of a FrameBlock
    ivec2 extent; // pixels
    uvec2 firstTile; // of those that are drawn
    uint tilesAcross;
};

const uint kFieldQuilez = 0u;
const uint kFieldAaltonen = 1u;
const uint kFieldCone1 = 2u; // Ban et al., Algorithm 2
const uint kFieldSubCones = 3u;

const uint kFieldTraced = 4u;

// Shares of area lights that are seen past all fields.
struct FieldShade
{
    FieldsBlock fields;
    uint64_t area; // AreaBlock
    uint64_t counters; // CounterBlock
    uint64_t seen; // float[lightCount][pixels of the lit image], written
    uint frame; // slot of a FrameBlock
    uint depth;
    uint normals;
    uint cones;
    uint cells;
    uint rays;
    float tolerance; // of kFieldCone1
    int pixelScale; // of the lit image to the G-buffer: 1, 2, 4
    uint litWidth; // pixels
    uint litHeight;
    uint albedo; // of the G-buffer, where characters are fields to lights
    uint seenGroups; // of the fields that hide all lights; those behind them stand for characters
    uint firstByBones; // lights that these hide too: of [firstByBones, endByBones), others meet the meshes
    uint endByBones;
};

struct FieldCase
{
    vec3 position;
    vec3 centre; // of the light
    float radius;
    FieldsBlock fields; // without surfaces
};

struct FieldAnswer
{
    float visibility;
    uint evaluations;
};

struct EvalField
{
    uint64_t cases; // FieldCase[caseCount]
    uint64_t answers; // FieldAnswer[caseCount], written
    uint caseCount;
    uint method;
    uint cones; // of kFieldSubCones: 1, 4, 7, 16
    float tolerance; // of kFieldCone1
};

#endif
