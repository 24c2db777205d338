// What both ray back-ends offer, ray by ray; the define names the back-end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/occlusion.h"
#ifdef COMPUTE_BVH
#include "lib/bvh.glsl"
#else
#include "lib/ray_query.glsl"
#endif

struct In { uint64_t scene; vec3 origin; vec3 direction; float far; uint padding; };
struct Out { uint isHidden; uint isHiddenOfAll; };

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
    Outputs(pc.outputs).value[i] = Out(uint(dynamicHitFirst(x.scene, x.origin, x.direction, x.far, -1.0) >= 0.0),
                                       uint(dynamicHitFirstOfAll(x.scene, x.origin, x.direction, -1.0) >= 0.0));
}
