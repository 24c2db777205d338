// Irradiance that one sphere hides, for cases of golden/README.md, by the estimator of occlusion_trace.comp: one thread a case.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/area.h"
#include "shared/eval.h"
#include "lib/hemisphere.glsl"
#include "lib/sh.glsl"
#include "lib/cone.glsl"
#include "lib/intersect.glsl"

layout(buffer_reference, scalar) readonly buffer Cases { IrradianceCase block[]; };
layout(buffer_reference, scalar) readonly buffer Samples { vec3 direction[]; };
layout(buffer_reference, scalar) writeonly buffer Occluded { float irradiance[]; };
layout(push_constant, scalar) uniform Push { EvalIrradiance pc; };

layout(local_size_x = 64) in;

float occludedIrradiance(IrradianceCase at)
{
    if (isBehind(at.position, at.normal, at.centre, at.radius))
        return 0.0;
    Cone cone = coneOfSphere(at.position, at.normal, at.centre, at.radius);
    mat3 frame = tangentFrame(at.normal);
    float hidden[9] = float[9](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint i = 0u; i < pc.sampleCount; ++i) {
        vec3 direction = frame * Samples(pc.samples).direction[i];
        if (!holds(cone, direction) || !hitsSphere(at.position, direction, at.centre, at.radius))
            continue;
        float y[9];
        shBasis3(direction, y);
        for (int k = 0; k < 9; ++k)
            hidden[k] += y[k];
    }
    float sum = 0.0;
    for (int k = 0; k < 9; ++k)
        sum += at.radianceSh[k] * hidden[k];
    return sum * (kPi / float(pc.sampleCount));
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index < pc.caseCount)
        Occluded(pc.occluded).irradiance[index] = occludedIrradiance(Cases(pc.cases).block[index]);
}
