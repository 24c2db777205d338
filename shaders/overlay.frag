#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/overlay.h"

layout(push_constant, scalar) uniform Push { OverlayDraw pc; };

layout(location = 0) in vec4 color;
layout(location = 1) in vec2 uv;

layout(location = 0) out vec4 outColor; // sRGB-encoded, as the picture is

void main()
{
    // Glyphs are drawn texel for pixel, all else reads one white texel: there is nothing to filter.
    float coverage = texture(sampler2D(sampledImages[pc.font], samplers[kNearestClamp]), uv).r;
    outColor = vec4(color.rgb, color.a * coverage);
}
