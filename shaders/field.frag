#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "lib/frame.glsl"
#include "lib/half.glsl"
#include "lib/surface.glsl"
#include "lib/field.glsl"
#include "lib/field_surface.glsl"
#include "lib/first_term.glsl"

// What the camera sees of signed distance fields, in the G-buffer among the meshes. Variants as of gbuffer.frag: LOCAL_LIGHT, DARK,
// KEEPS_MATERIAL; KEEPS_STEPS where the steps of the way are asked for.
layout(push_constant, scalar) uniform Push { FieldDraw pc; };

layout(location = 0) flat in vec2 inWay; // as field.vert has them
layout(location = 1) flat in uvec2 inSkipped;

layout(location = 0) out vec4 outNormals; // octahedral: geometric, shading
layout(location = 1) out vec4 outAlbedo; // a: 1 for what moves
layout(location = 2) out vec4 outUnshadowed; // W/m^2; a: roughness
#ifdef KEEPS_MATERIAL
layout(location = 3) out vec4 outMaterial; // roughness, metallic, specular
#endif
#ifdef KEEPS_STEPS
#ifdef KEEPS_MATERIAL
layout(location = 4) out vec4 outSteps;
#else
layout(location = 3) out vec4 outSteps;
#endif
#endif

void main()
{
    holdSteps(pc.fields);
    vec3 ray = fromEye(frameBlock, gl_FragCoord.xy, 1.0);
    float metresADepth = length(ray);
    vec3 direction = ray / metresADepth;
    vec2 way = vec2(max(inWay.x, frameBlock.near * metresADepth), inWay.y);
    float pixel = length(frameBlock.rayX) / metresADepth; // metres a metre of the way
    FieldsBlock fields = pc.fields;
    fields.skipped = inSkipped;
    FieldHit hit = traceField(fields, frameBlock.eye, direction, way.x, way.y, 0.3 * pixel);
    bool isHit = hit.at > 0.0;
    vec3 position = frameBlock.eye + direction * max(hit.at, 0.0);
    float width = 0.2 * pixel * max(hit.at, 0.0) + 1.0e-5;
    vec3 normal = fieldNormal(fields, position, width, isHit);
    normal = dot(normal, direction) > 0.0 ? -normal : normal; // the side that is seen is the side that is lit
    FieldSurfaceBlock surface = fieldSurface(fields, position, 2.0 * width, isHit);

    gl_FragDepth = isHit ? clamp(frameBlock.near * metresADepth / hit.at, 0.0, 1.0) : 0.0;
    outNormals = vec4(octahedralFromUnit(normal), octahedralFromUnit(normal));
    outAlbedo = vec4(surface.albedo, 1.0);
    outUnshadowed = vec4(withinHalf(firstTermAt(frameBlock, position, normal, gl_HelperInvocation)), surface.roughness);
#ifdef KEEPS_MATERIAL
    outMaterial = vec4(surface.roughness, surface.metallic, surface.specular, 0.0);
#endif
#ifdef KEEPS_STEPS
    outSteps = vec4(float(hit.steps), 0.0, 0.0, 0.0);
#endif
    if (!isHit)
        discard; // last, as quads share look-ups
}
