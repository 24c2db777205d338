#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/scene.h"

layout(buffer_reference, scalar) readonly buffer Instance { InstanceBlock block; };
layout(buffer_reference, scalar) readonly buffer Vectors { vec3 value[]; };
layout(buffer_reference, scalar) readonly buffer Uvs { vec2 value[]; };
layout(push_constant, scalar) uniform Push { GBufferDraw pc; };

layout(location = 0) out vec3 positionWorld;
layout(location = 1) out vec3 normalWorld;
layout(location = 2) out vec2 uv;

void main()
{
    Instance instance = Instance(pc.instance);
    positionWorld = vec3(instance.block.worldFromLocal * vec4(Vectors(instance.block.positions).value[gl_VertexIndex], 1.0));
    normalWorld = mat3(instance.block.normalFromLocal) * Vectors(instance.block.normals).value[gl_VertexIndex];
    uv = Uvs(instance.block.uvs).value[gl_VertexIndex];
    gl_Position = frameBlock.clipFromWorld * vec4(positionWorld, 1.0);
}
