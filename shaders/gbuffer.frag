#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/scene.h"
#include "lib/half.glsl"
#include "lib/octahedral.glsl"
#ifdef BAKED
#include "lib/atlas.glsl"
#else
#include "lib/first_term.glsl"
#endif

// Variants: TEXTURED where the material may have an image; CUT_OUT, beside it, where it is cut out: discarding puts off the depth test.
// The first term is the environment's, what is baked (BAKED), that of baked light that comes in there (LOCAL_LIGHT), or nothing (DARK).
// KEEPS_MATERIAL where area lights are reflected by more than albedo.
layout(push_constant, scalar) uniform Push { GBufferDraw pc; };

layout(location = 0) in vec3 positionWorld;
layout(location = 1) in vec3 normalWorld;
#ifdef TEXTURED
layout(location = 2) in vec2 uv;
#endif
#ifdef BAKED
layout(location = 3) in vec2 bakePlace; // on the atlas, texels
#endif

layout(location = 0) out vec4 outNormals; // octahedral: geometric, shading
layout(location = 1) out vec4 outAlbedo; // a: 1 for what moves
layout(location = 2) out vec4 outUnshadowed; // W/m^2; a: roughness
#ifdef KEEPS_MATERIAL
layout(location = 3) out vec4 outMaterial; // roughness, metallic, specular
#endif

vec3 firstTerm(vec3 shading)
{
#ifdef BAKED
    return atlasIrradiance(frameBlock.baked, bakePlace);
#else
    return firstTermAt(frameBlock, positionWorld, shading, gl_HelperInvocation);
#endif
}

void main()
{
    vec4 base = vec4(pc.material.albedo, pc.material.alpha);
#ifdef TEXTURED
    if (pc.material.albedoImage != kNoImage)
        base *= texture(sampler2D(sampledImages[pc.material.albedoImage], samplers[kLinearRepeat]), uv);
#endif

    vec3 toEye = frameBlock.eye - positionWorld;
    vec3 geometric = cross(dFdx(positionWorld), dFdy(positionWorld));
    // Of any length, as its octahedral square does not mind. A triangle seen edge-on has no derivatives to speak of.
    geometric = dot(geometric, geometric) > 0.0 ? geometric : toEye;
    geometric = dot(geometric, toEye) < 0.0 ? -geometric : geometric;
    vec3 shading = dot(normalWorld, normalWorld) > 0.0 ? normalWorld : geometric;
    // The side that is seen is the side that is lit.
    shading = normalize(dot(shading, geometric) < 0.0 ? -shading : shading);

    outNormals = vec4(octahedralFromUnit(geometric), octahedralFromUnit(shading));
    outAlbedo = vec4(base.rgb, (pc.flags & kDrawDynamic) != 0u ? 1.0 : 0.0);
    outUnshadowed = vec4(withinHalf(firstTerm(shading)), pc.material.roughness);
#ifdef KEEPS_MATERIAL
    outMaterial = vec4(pc.material.roughness, pc.material.metallic, pc.material.specular, 0.0);
#endif
#ifdef CUT_OUT
    if (base.a < pc.material.alphaCutoff)
        discard; // last, as neighbours ask for derivatives and quads share look-ups
#endif
}
