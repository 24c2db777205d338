// shaders/lib/field.glsl, field_cone.glsl and field_baseline.glsl, one function at a time: the define names it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/field.glsl"
#include "lib/field_cone.glsl"
#include "lib/field_baseline.glsl"

#ifdef CAP_COVERAGE

struct In { float m; float sine; };
struct Out { float share; };
Out evaluate(In x) { return Out(capCoverage(x.m, x.sine)); }

#else

struct In { vec3 position; vec3 centre; float radius; uint cones; FieldsBlock fields; };
struct Out { float value; uint evaluations; };

float valueOf(In x)
{
#if defined(FIELD_DISTANCE)
    return fieldDistance(x.fields, x.position);
#elif defined(QUILEZ)
    return quilezVisibility(x.fields, x.position, x.centre, x.radius);
#elif defined(AALTONEN)
    return aaltonenVisibility(x.fields, x.position, x.centre, x.radius);
#elif defined(ONE_CONE)
    return coneVisibility(x.fields, x.position, x.centre, x.radius, 0.1);
#else
    return subConeVisibility(x.fields, x.position, x.centre, x.radius, x.cones);
#endif
}

Out evaluate(In x)
{
    float value = valueOf(x);
    return Out(value, fieldEvaluations);
}

#endif

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
    if (i < pc.count)
        Outputs(pc.outputs).value[i] = evaluate(Inputs(pc.inputs).value[i]);
}
