// What of a sphere light is seen past a signed distance field, for cases of golden/README.md: one thread a case. Variant METHOD.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/field.glsl"
#include "lib/field_cone.glsl"
#include "lib/field_baseline.glsl"

layout(buffer_reference, scalar) readonly buffer Cases { FieldCase block[]; };
layout(buffer_reference, scalar) writeonly buffer Answers { FieldAnswer block[]; };
layout(push_constant, scalar) uniform Push { EvalField pc; };

layout(local_size_x = 64) in;

float visibilityOf(FieldCase at)
{
    switch (pc.method) {
    case kFieldQuilez: return quilezVisibility(at.fields, at.position, at.centre, at.radius);
    case kFieldAaltonen: return aaltonenVisibility(at.fields, at.position, at.centre, at.radius);
    case kFieldCone1: return coneVisibility(at.fields, at.position, at.centre, at.radius, pc.tolerance);
    default: return subConeVisibility(at.fields, at.position, at.centre, at.radius, pc.cones);
    }
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= pc.caseCount)
        return;
    float visibility = visibilityOf(Cases(pc.cases).block[index]);
    Answers(pc.answers).block[index] = FieldAnswer(visibility, fieldEvaluations);
}
