#version 460
#extension GL_GOOGLE_include_directive : require

// One triangle over the picture, at the far end of reversed depth.
void main() { gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4.0 - 1.0, 0.0, 1.0); }
