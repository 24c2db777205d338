// Rays through distance fields (shaders/lib/field_ray.glsl, field_boxes.glsl, field_pool.glsl): by which groups each may meet, asked one by
// one and by ray query; and how far it goes alone and in a pool with the others of its group of threads, whose fields are those of the first.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/occlusion.h"
#include "lib/field.glsl"
#include "lib/ray_query.glsl"
#include "lib/field_ray.glsl"
#include "lib/field_boxes.glsl"

struct In { uint64_t scene; vec3 origin; vec3 direction; float far; uint padding; FieldsBlock fields; };
struct Out { uvec2 asked; uvec2 queried; vec2 askedWay; vec2 queriedWay; float alone; float pooled; };

layout(buffer_reference, scalar) readonly buffer Inputs { In value[]; };
layout(buffer_reference, scalar) writeonly buffer Outputs { Out value[]; };
layout(push_constant, scalar) uniform Push
{
    uint64_t inputs;
    uint64_t outputs;
    uint count;
} pc;

layout(local_size_x = 64) in;

#include "lib/field_pool.glsl"

FieldRay pooledRay(uint i)
{
    In x = Inputs(pc.inputs).value[i];
    return fieldRay(x.origin, x.direction);
}

void addPooledGroups(FieldsBlock fields, uint i, inout FieldRay ray) { addGroups(fields, Inputs(pc.inputs).value[i].far, ray); }

void main()
{
    uint first = gl_WorkGroupID.x * gl_WorkGroupSize.x, i = gl_GlobalInvocationID.x;
    In x = Inputs(pc.inputs).value[min(i, pc.count - 1u)];
    FieldRay asked = fieldRay(x.origin, x.direction), queried = asked;
    addGroups(x.fields, x.far, asked);
    addGroups(x.scene, x.fields, x.far, queried);
    traceThroughFields(x.fields, first, min(first + gl_WorkGroupSize.x, pc.count));
    if (i < pc.count)
        Outputs(pc.outputs).value[i] =
            Out(asked.groups, queried.groups, asked.way, queried.way, distanceToField(x.fields, asked), pooledHit(first, i));
}
