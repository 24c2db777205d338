// The first term of irradiance where no atlas holds it, W/m^2: that of baked light that comes in there (LOCAL_LIGHT), nothing (DARK), else the
// environment's. For fragments.
#ifndef LIB_FIRST_TERM_GLSL
#define LIB_FIRST_TERM_GLSL

#ifdef LOCAL_LIGHT
#include "lib/irradiance_volume.glsl"
#else
#include "lib/sh.glsl"
#endif

vec3 firstTermAt(FrameBlock frame, vec3 positionWorld, vec3 normal, bool isHelper)
{
#if defined(LOCAL_LIGHT)
    return localIrradianceOfQuad(frame.baked, positionWorld, normal, isHelper);
#elif defined(DARK)
    return vec3(0.0);
#else
    float y[9];
    shBasis3(normal, y);
    vec3 irradiance = vec3(0.0);
    for (int i = 0; i < 9; ++i)
        irradiance += frame.irradianceSh[i] * y[i];
    return irradiance;
#endif
}

#endif
