#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/scene.h"
#include "lib/tone.glsl"

// What an area light looks like: its radiance, and black behind. Variant KEEPS_COLOR: the radiance is asked for beside the picture.
layout(push_constant, scalar) uniform Push { LightBodyDraw pc; };

layout(location = 0) in float facing;
layout(location = 0) out vec4 outPicture;
#ifdef KEEPS_COLOR
layout(location = 1) out vec4 outColor;
#endif

void main()
{
    vec3 radiance = facing > 0.0 || pc.isTwoSided != 0u ? pc.radiance : vec3(0.0);
    outPicture = vec4(srgbEncoded(toneMapped(radiance * pc.exposure)), 1.0);
#ifdef KEEPS_COLOR
    outColor = vec4(radiance, 0.0);
#endif
}
