#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "shared/scene.h"
#include "lib/octahedral.glsl"
#include "lib/sh.glsl"

// Variant TEXTURED: some material of the model has an image or is cut out.
layout(buffer_reference, scalar) readonly buffer Materials { MaterialBlock block[]; };
layout(buffer_reference, scalar) readonly buffer Indices { uint value[]; };
layout(push_constant, scalar) uniform Push { GBufferDraw pc; };

layout(location = 0) in vec3 positionWorld;
layout(location = 1) in vec3 normalWorld;
layout(location = 2) in vec2 uv;

layout(location = 0) out vec4 outNormals; // octahedral: geometric, shading
layout(location = 1) out vec4 outAlbedo; // a: 1 for what moves
layout(location = 2) out vec4 outUnshadowed; // W/m^2; a: roughness

void main()
{
    MaterialBlock material = Materials(pc.materials).block[Indices(pc.triangleMaterials).value[gl_PrimitiveID]];
    vec4 base = vec4(material.albedo, material.alpha);
#ifdef TEXTURED
    if (material.albedoImage != kNoImage)
        base *= texture(sampler2D(sampledImages[nonuniformEXT(material.albedoImage)], samplers[kLinearRepeat]), uv);
    if (base.a < material.alphaCutoff)
        discard;
#endif

    vec3 toEye = frameBlock.eye - positionWorld;
    vec3 geometric = cross(dFdx(positionWorld), dFdy(positionWorld));
    float squared = dot(geometric, geometric);
    // A triangle seen edge-on has no derivatives to speak of.
    geometric = squared > 0.0 ? geometric * inversesqrt(squared) : normalize(toEye);
    geometric = dot(geometric, toEye) < 0.0 ? -geometric : geometric;
    vec3 shading = dot(normalWorld, normalWorld) > 0.0 ? normalize(normalWorld) : geometric;
    // The side that is seen is the side that is lit.
    shading = dot(shading, geometric) < 0.0 ? -shading : shading;

    float y[9];
    shBasis3(shading, y);
    vec3 irradiance = vec3(0.0);
    for (int i = 0; i < 9; ++i)
        irradiance += frameBlock.irradianceSh[i] * y[i];

    outNormals = vec4(octahedralFromUnit(geometric), octahedralFromUnit(shading));
    outAlbedo = vec4(base.rgb, (pc.flags & kDrawDynamic) != 0u ? 1.0 : 0.0);
    outUnshadowed = vec4(irradiance, material.roughness);
}
