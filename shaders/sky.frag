#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/composite.h"
#include "lib/tone.glsl"

layout(push_constant, scalar) uniform Push { Sky pc; };

// Variant KEEPS_COLOR: the radiance is asked for beside the picture.
layout(location = 0) out vec4 outPicture;
#ifdef KEEPS_COLOR
layout(location = 1) out vec4 outColor;
#endif

const float kInversePi = 0.3183098861837907;

// The environment where nothing is: the depth test leaves only those pixels.
void main()
{
    vec3 d = normalize(frameBlock.cornerRay + gl_FragCoord.x * frameBlock.rayX + gl_FragCoord.y * frameBlock.rayY);
    // The light turned by +angle about +Y is looked up at -angle.
    float c = frameBlock.environmentTurn.x, s = frameBlock.environmentTurn.y;
    d = vec3(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
    vec2 uv = vec2(0.5 + atan(d.x, -d.z) * (0.5 * kInversePi), acos(clamp(d.y, -1.0, 1.0)) * kInversePi);
    vec3 radiance = textureLod(sampler2D(sampledImages[frameBlock.environment], samplers[kLinearWrapU]), uv, 0.0).rgb;
    radiance *= frameBlock.environmentIntensity;
    outPicture = vec4(srgbEncoded(toneMapped(radiance * pc.exposure)), 1.0);
#ifdef KEEPS_COLOR
    outColor = vec4(radiance, 0.0);
#endif
}
