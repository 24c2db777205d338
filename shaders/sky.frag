#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/composite.h"

layout(push_constant, scalar) uniform Push { Sky pc; };

layout(location = 0) out vec4 outColor;

const float kInversePi = 0.3183098861837907;

// The environment where nothing is: the depth test leaves only those pixels.
void main()
{
    vec3 d = normalize(frameBlock.cornerRay + gl_FragCoord.x * frameBlock.rayX + gl_FragCoord.y * frameBlock.rayY);
    // The light turned by +angle about +Y is looked up at -angle.
    float c = cos(frameBlock.environmentRotation), s = sin(frameBlock.environmentRotation);
    d = vec3(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
    vec2 uv = vec2(0.5 + atan(d.x, -d.z) * (0.5 * kInversePi), acos(clamp(d.y, -1.0, 1.0)) * kInversePi);
    vec3 radiance = textureLod(sampler2D(sampledImages[frameBlock.environment], samplers[kLinearWrapU]), uv, 0.0).rgb;
    outColor = vec4(radiance * frameBlock.environmentIntensity, 0.0);
}
