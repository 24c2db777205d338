#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/scene.h"
#ifdef BAKED
#include "lib/atlas.glsl"
#endif

layout(buffer_reference, scalar) readonly buffer Vectors { vec3 value[]; };
layout(buffer_reference, scalar) readonly buffer Uvs { vec2 value[]; };
layout(push_constant, scalar) uniform Push { GBufferDraw pc; };

layout(location = 0) out vec3 positionWorld;
layout(location = 1) out vec3 normalWorld;
#ifdef TEXTURED
layout(location = 2) out vec2 uv;
#endif
#ifdef BAKED
layout(location = 3) out vec2 bakePlace;
#endif

void main()
{
    vec3 position = Vectors(pc.positions).value[gl_VertexIndex], normal = Vectors(pc.normals).value[gl_VertexIndex];
    vec3 x = pc.worldFromLocal[0].xyz, y = pc.worldFromLocal[1].xyz, z = pc.worldFromLocal[2].xyz;
    positionWorld = vec3(dot(x, position), dot(y, position), dot(z, position)) +
                    vec3(pc.worldFromLocal[0].w, pc.worldFromLocal[1].w, pc.worldFromLocal[2].w);
    // The cofactor matrix, whose sign the fragment shader does not mind.
    normalWorld = vec3(dot(cross(y, z), normal), dot(cross(z, x), normal), dot(cross(x, y), normal));
#ifdef TEXTURED
    uv = Uvs(pc.uvs).value[gl_VertexIndex];
#endif
#ifdef BAKED
    bakePlace = placeOnAtlas(frameBlock.baked, Uvs(pc.bakeUvs).value[gl_VertexIndex]);
#endif
    gl_Position = frameBlock.clipFromWorld * vec4(positionWorld, 1.0);
}
