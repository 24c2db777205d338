// Cones, their merging and what rays meet of them, for cases of golden/README.md: one thread a case.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/skinning.h"
#include "shared/area.h"
#include "shared/eval.h"
#include "lib/cone.glsl"
#include "lib/cone_merge.glsl"

layout(buffer_reference, scalar) readonly buffer Cases { ConeCase block[]; };
layout(buffer_reference, scalar) readonly buffer Spheres { SphereBlock block[]; };
layout(buffer_reference, scalar) buffer Cones { ConeBlock block[]; };
layout(buffer_reference, scalar) buffer Probes { ProbeBlock block[]; };
layout(push_constant, scalar) uniform Push { EvalCones pc; };

layout(local_size_x = 64) in;

ConeBlock blockOf(ConeCase at, uint sphere)
{
    SphereBlock s = Spheres(pc.spheres).block[at.firstSphere + sphere];
    if (isBehind(at.position, at.normal, s.centre, s.radius))
        return ConeBlock(vec3(0.0), 0.0, 0.0, 0.0, 0.0, kConeNone, sphere);
    Cone cone = coneOfSphere(at.position, at.normal, s.centre, s.radius);
    return ConeBlock(cone.axis, cone.chord, cone.halfAngle, cone.height, cone.height, cone.all ? kConeAll : kConePart, sphere);
}

Cone coneOf(ConeBlock block) { return Cone(block.axis, -1.0, block.chord, block.halfAngle, block.mergedHeight, block.kind == kConeAll); }

// The first in order of those that absorb it, or itself.
uint keeperOf(ConeCase at, uint sphere)
{
    Cones cones = Cones(pc.cones);
    Cone cone = coneOf(cones.block[at.firstSphere + sphere]);
    Cone keeper = cone;
    uint index = sphere;
    for (uint k = 0u; k < at.sphereCount; ++k) {
        ConeBlock block = cones.block[at.firstSphere + k];
        Cone other = coneOf(block);
        if (block.kind != kConeNone && absorbs(other, k, cone, sphere) && precedes(other, k, keeper, index)) {
            keeper = other;
            index = k;
        }
    }
    return index;
}

void merge(ConeCase at)
{
    Cones cones = Cones(pc.cones);
    for (uint k = 0u; k < at.sphereCount; ++k)
        if (cones.block[at.firstSphere + k].kind != kConeNone)
            cones.block[at.firstSphere + k].keeper = keeperOf(at, k);
    for (uint k = 0u; k < at.sphereCount; ++k) {
        // What absorbs a keeper absorbs what that keeps as well, unless rounding comes between.
        uint keeper = k;
        while (cones.block[at.firstSphere + keeper].keeper != keeper)
            keeper = cones.block[at.firstSphere + keeper].keeper;
        cones.block[at.firstSphere + k].keeper = keeper;
        ConeBlock kept = cones.block[at.firstSphere + keeper];
        cones.block[at.firstSphere + keeper].mergedHeight = max(kept.mergedHeight, cones.block[at.firstSphere + k].height);
    }
}

void probe(ConeCase at, uint index)
{
    ProbeBlock found = Probes(pc.probes).block[index];
    found.isTraced = 0u;
    found.far = 0.0;
    for (uint k = 0u; k < at.sphereCount; ++k) {
        ConeBlock block = Cones(pc.cones).block[at.firstSphere + k];
        if (block.kind == kConeNone || block.keeper != k || !holds(coneOf(block), found.direction))
            continue;
        found.isTraced = 1u;
        found.far = max(found.far, block.mergedHeight);
    }
    Probes(pc.probes).block[index] = found;
}

void main()
{
    if (gl_GlobalInvocationID.x >= pc.caseCount)
        return;
    ConeCase at = Cases(pc.cases).block[gl_GlobalInvocationID.x];
    for (uint k = 0u; k < at.sphereCount; ++k)
        Cones(pc.cones).block[at.firstSphere + k] = blockOf(at, k);
    merge(at);
    for (uint k = 0u; k < at.probeCount; ++k)
        probe(at, at.firstProbe + k);
}
