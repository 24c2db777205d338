#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/skinning.h"

// One group: the sphere about a posed character, centred in the box of its capsules.
layout(local_size_x = 64) in;

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 value[]; };
layout(buffer_reference, scalar) readonly buffer Capsules { CapsuleBlock block[]; };
layout(buffer_reference, scalar) writeonly buffer Sphere { SphereBlock block; };
layout(push_constant, scalar) uniform Push { SphereFitDispatch pc; };

shared float greatest[64];

void main()
{
    vec3 lowest = vec3(1.0e30), highest = vec3(-1.0e30);
    for (uint c = 0u; c < pc.boneCount; ++c) {
        CapsuleBlock capsule = Capsules(pc.capsules).block[c];
        vec3 extent = abs(capsule.arm) + capsule.radius;
        lowest = min(lowest, capsule.middle - extent);
        highest = max(highest, capsule.middle + extent);
    }
    vec3 centre = 0.5 * (lowest + highest);
    float radius2 = 0.0;
    for (uint v = gl_LocalInvocationIndex; v < pc.vertexCount; v += 64u) {
        vec3 off = Vectors(pc.posedPositions).value[v] - centre;
        radius2 = max(radius2, dot(off, off));
    }
    greatest[gl_LocalInvocationIndex] = radius2;
    barrier();
    for (uint width = 32u; width > 0u; width /= 2u) {
        if (gl_LocalInvocationIndex < width)
            greatest[gl_LocalInvocationIndex] = max(greatest[gl_LocalInvocationIndex], greatest[gl_LocalInvocationIndex + width]);
        barrier();
    }
    if (gl_LocalInvocationIndex == 0u)
        Sphere(pc.sphere).block = SphereBlock(centre, 1.001 * sqrt(greatest[0]) + 1.0e-6);
}
