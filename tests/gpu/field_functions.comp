// shaders/lib/field.glsl, field_cone.glsl and field_baseline.glsl, one function at a time: the define names it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/field.glsl"
#include "lib/field_cone.glsl"
#include "lib/field_baseline.glsl"
#define POLYGON_PLACES 6
#define POLYGON_CORNERS 16
#include "lib/cone_polygon.glsl"
#include "lib/field_cells.glsl"
#include "lib/field_samples.glsl"

#ifdef CAP_COVERAGE

struct In { float m; float sine; };
struct Out { float share; };
Out evaluate(In x) { return Out(capCoverage(x.m, x.sine)); }

#elif defined(RECTANGLE_SHARE)

struct In { vec2 low; vec2 high; };
struct Out { float share; };
Out evaluate(In x) { return Out(rectangleShare(x.low, x.high)); }

#elif defined(CELLS) || defined(EDGE_SAMPLES)

// A parallelogram that faces the point.
struct In { vec3 position; vec3 normal; vec3 corner; vec3 edgeA; vec3 edgeB; uint cells; FieldsBlock fields; };
struct Out { float value; uint evaluations; };
Out evaluate(In x)
{
    vec3 a = x.corner - x.position, across = cross(x.edgeA, x.edgeB);
    vec3 corners[4] = vec3[4](a, a + x.edgeA, a + x.edgeA + x.edgeB, a + x.edgeB);
    mat3 frame = tangentFrame(x.normal);
    bool isTurned = dot(a, across) > 0.0;
    int count = 0;
    for (int i = 0; i < 4; ++i)
        addCellCorner(frame, count, corners[isTurned ? i : 3 - i], corners[isTurned ? (i + 1) % 4 : (6 - i) % 4]);
    cornerCounts[kCellLight + 1] = count;
    vec3 normal = normalize(across) * (isTurned ? 1.0 : -1.0);
    vec4 plane = vec4(normal, dot(normal, a));
#ifdef CELLS
    float share = cellVisibility(x.fields, x.position, frame, plane, x.cells);
#else
    float share = edgeSampleVisibility(x.fields, x.position, frame, plane, x.cells);
#endif
    return Out(share, fieldEvaluations);
}

#else

struct In { vec3 position; vec3 centre; float radius; uint cones; FieldsBlock fields; };
struct Out { float value; uint evaluations; };

float valueOf(In x)
{
#if defined(FIELD_DISTANCE)
    return fieldDistance(x.fields, x.position);
#elif defined(FIELD_DISTANCE_WITHIN)
    return fieldDistance(x.fields, x.position, x.radius);
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
