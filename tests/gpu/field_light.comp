// shaders/lib/field_light.glsl: what of a body is seen past a field.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#define POLYGON_PLACES 6
#define POLYGON_CORNERS 36
#define SILHOUETTE_EDGES 64
#define SILHOUETTE_BODY_EDGES 64
#define FACE_WORDS 4
#define OUTLINE_CORNERS 30
#define LIGHT_VERTICES 64
#define AREA_OCCLUDERS 1
#include "lib/field.glsl"
#include "lib/field_cone.glsl"
#include "lib/area_occluders.glsl"
#include "lib/field_cells.glsl"
#include "lib/field_light.glsl"

struct In { vec3 position; vec3 normal; uint body; uint cells; BodyArrays arrays; FieldsBlock fields; };
struct Out { float value; uint evaluations; };

layout(buffer_reference, scalar) readonly buffer Inputs { In value[]; };
layout(buffer_reference, scalar) writeonly buffer Outputs { Out value[]; };
layout(push_constant, scalar) uniform Push
{
    uint64_t inputs;
    uint64_t outputs;
    uint count;
} pc;

layout(local_size_x = 64) in;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= pc.count)
        return;
    In x = Inputs(pc.inputs).value[i];
    float share = lightVisibility(x.fields, x.arrays, Bodies(x.arrays.bodies).body[x.body], x.position, x.normal, x.cells);
    Outputs(pc.outputs).value[i] = Out(share, fieldEvaluations);
}
