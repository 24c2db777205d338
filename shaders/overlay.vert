#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/overlay.h"

layout(buffer_reference, scalar) readonly buffer Vertices { OverlayVertex value[]; };
layout(buffer_reference, scalar) readonly buffer Indices { uint pair[]; };
layout(push_constant, scalar) uniform Push { OverlayDraw pc; };

layout(location = 0) out vec4 color;
layout(location = 1) out vec2 uv;

void main()
{
    uint place = pc.firstIndex + uint(gl_VertexIndex);
    uint index = bitfieldExtract(Indices(pc.indices).pair[place / 2u], int(16u * (place % 2u)), 16);
    OverlayVertex vertex = Vertices(pc.vertices).value[pc.firstVertex + index];
    color = unpackUnorm4x8(vertex.color);
    uv = vertex.uv;
    gl_Position = vec4(2.0 * vertex.position / pc.extent - 1.0, 0.0, 1.0);
}
