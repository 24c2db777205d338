#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/scene.h"

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 value[]; };
layout(push_constant, scalar) uniform Push { LightBodyDraw pc; };

layout(location = 0) out float facing; // more than nothing where the side that shines is seen

void main()
{
    vec3 position = Vectors(pc.positions).value[gl_VertexIndex], normal = Vectors(pc.normals).value[gl_VertexIndex];
    vec3 x = pc.worldFromLocal[0].xyz, y = pc.worldFromLocal[1].xyz, z = pc.worldFromLocal[2].xyz;
    vec3 positionWorld = vec3(dot(x, position), dot(y, position), dot(z, position)) +
                         vec3(pc.worldFromLocal[0].w, pc.worldFromLocal[1].w, pc.worldFromLocal[2].w);
    // By the cofactor matrix, which mirrors where the transform does.
    vec3 normalWorld = vec3(dot(cross(y, z), normal), dot(cross(z, x), normal), dot(cross(x, y), normal)) * sign(dot(x, cross(y, z)));
    facing = dot(normalWorld, frameBlock.eye - positionWorld);
    gl_Position = frameBlock.clipFromWorld * vec4(positionWorld, 1.0);
}
