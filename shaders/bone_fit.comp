#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/skinning.h"

// One group a bone: the capsule about the posed bone axis that holds all triangles given to the bone. A capsule is convex, so holding
// the corners is holding the triangles: the capsules of all bones together hold the whole posed mesh, whatever moves it.
layout(local_size_x = 64) in;

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 value[]; };
layout(buffer_reference, scalar) readonly buffer Matrices { mat4 value[]; };
layout(buffer_reference, scalar) readonly buffer Bones { BoneBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Indices { uint value[]; };
layout(buffer_reference, scalar) writeonly buffer Capsules { CapsuleBlock block[]; };
layout(push_constant, scalar) uniform Push { BoneFitDispatch pc; };

shared float greatest[64];

void main()
{
    BoneBlock bone = Bones(pc.bones).block[gl_WorkGroupID.x];
    mat4 joint = Matrices(pc.joints).value[bone.joint];
    vec3 a = vec3(joint * vec4(bone.a, 1.0)), b = vec3(joint * vec4(bone.b, 1.0));
    vec3 ab = b - a;
    float inverse = 1.0 / max(dot(ab, ab), 1.0e-20);
    float radius2 = 0.0;
    for (uint i = gl_LocalInvocationIndex; i < bone.vertexCount; i += 64u) {
        vec3 p = Vectors(pc.posedPositions).value[Indices(pc.boneVertices).value[bone.firstVertex + i]] - a;
        vec3 off = p - clamp(dot(p, ab) * inverse, 0.0, 1.0) * ab;
        radius2 = max(radius2, dot(off, off));
    }
    greatest[gl_LocalInvocationIndex] = radius2;
    barrier();
    for (uint width = 32u; width > 0u; width /= 2u) {
        if (gl_LocalInvocationIndex < width)
            greatest[gl_LocalInvocationIndex] = max(greatest[gl_LocalInvocationIndex], greatest[gl_LocalInvocationIndex + width]);
        barrier();
    }
    // A thousandth more covers the rounding of this and of every test against it.
    if (gl_LocalInvocationIndex == 0u) {
        float radius = 1.001 * sqrt(greatest[0]) + 1.0e-6;
        Capsules(pc.capsules).block[gl_WorkGroupID.x] = CapsuleBlock(0.5 * (a + b), radius, 0.5 * ab, radius + 0.5005 * length(ab));
    }
}
