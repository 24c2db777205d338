// The members of a shared struct, one after the other in their order, as the device reads them from the second of two in a row: an offset
// or a size that differs from the host's shifts them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/bindless.glsl"
#include "shared/frame.h"
#include "shared/scene.h"
#include "shared/skinning.h"
#include "shared/occlusion.h"
#include "shared/bvh.h"
#include "shared/composite.h"
#include "shared/area.h"
#include "shared/eval.h"
#include "shared/field.h"
#include "shared/prt.h"
#include "../tests/gpu/shared_structs.glsl"

#if defined(FRAME_BLOCK)

#define Block FrameBlock
void echo(FrameBlock b)
{
    put(b.clipFromWorld);
    put(b.eye);
    put(b.cornerRay);
    put(b.rayX);
    put(b.rayY);
    put(b.near);
    put(b.environment);
    put(b.environmentTurn);
    put(b.environmentIntensity);
    for (int i = 0; i < b.radianceSh.length(); ++i)
        put(b.radianceSh[i]);
    for (int i = 0; i < b.irradianceSh.length(); ++i)
        put(b.irradianceSh[i]);
    put(b.baked.texels);
    put(b.baked.cells);
    put(b.baked.origin);
    put(b.baked.cellsPerMetre);
    put(b.baked.lastCell);
    put(b.baked.lastTexel);
    for (int i = 0; i < b.baked.outside.length(); ++i)
        put(b.baked.outside[i]);
    put(b.baked.sentOn);
}

#elif defined(GBUFFER_DRAW)

#define Block GBufferDraw
void echo(GBufferDraw b)
{
    for (int i = 0; i < 3; ++i)
        put(b.worldFromLocal[i]);
    put(b.material);
    put(b.positions);
    put(b.normals);
    put(b.uvs);
    put(b.bakeUvs);
    put(b.frame);
    put(b.flags);
}

#elif defined(MATERIAL_BLOCK)

#define Block MaterialBlock
void echo(MaterialBlock b) { put(b); }

#elif defined(INFLUENCE_BLOCK)

#define Block InfluenceBlock
void echo(InfluenceBlock b)
{
    put(b.joints01);
    put(b.joints23);
    put(b.weights);
}

#elif defined(MORPH_BLOCK)

#define Block MorphBlock
void echo(MorphBlock b)
{
    put(b.firstVertex);
    put(b.count);
    put(b.positions);
    put(b.normals);
}

#elif defined(BONE_BLOCK)

#define Block BoneBlock
void echo(BoneBlock b)
{
    put(b.a);
    put(b.firstVertex);
    put(b.b);
    put(b.vertexCount);
    put(b.joint);
}

#elif defined(CAPSULE_BLOCK)

#define Block CapsuleBlock
void echo(CapsuleBlock b)
{
    put(b.middle);
    put(b.radius);
    put(b.arm);
    put(b.reach);
}

#elif defined(SPHERE_BLOCK)

#define Block SphereBlock
void echo(SphereBlock b)
{
    put(b.centre);
    put(b.radius);
}

#elif defined(BLOCKER_BLOCK)

#define Block BlockerBlock
void echo(BlockerBlock b)
{
    put(b.centre);
    put(b.radius);
    put(b.firstCapsule);
    put(b.capsuleCount);
}

#elif defined(BLOCKER_SOURCE)

#define Block BlockerSource
void echo(BlockerSource b)
{
    put(b.worldFromLocal);
    put(b.sphere);
    put(b.capsules);
    put(b.firstCapsule);
    put(b.capsuleCount);
    put(b.scale);
    put(b.padding);
}

#elif defined(OCCLUSION_TRACE)

#define Block OcclusionTrace
void echo(OcclusionTrace b)
{
    put(b.scene);
    put(b.samples);
    put(b.counters);
    put(b.blockers);
    put(b.capsules);
    put(b.fields);
    put(b.grounds);
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.occluded);
    put(b.isFiltered);
    put(b.sampleCount);
    put(b.blockerCount);
    put(b.groundCount);
    put(b.tolerance);
    put(b.pixelScale);
    put(b.frameIndex);
    put(b.padding);
}

#elif defined(GROUND_BLOCK)

#define Block GroundBlock
void echo(GroundBlock b)
{
    put(b.centre);
    put(b.radius);
    put(b.height);
    for (uint i = 0u; i < kGroundRings; ++i)
        put(b.missed[i]);
}

#elif defined(BVH_NODE)

#define Block BvhNode
void echo(BvhNode b)
{
    put(b.lowest);
    put(b.firstTriangle);
    put(b.highest);
    put(b.triangleCount);
}

#elif defined(BVH_INSTANCE) || defined(BVH_PLACEMENT)

void echoInstance(BvhInstance b)
{
    for (int i = 0; i < 3; ++i)
        put(b.localFromWorld[i]);
    put(b.nodes);
    put(b.positions);
    put(b.indices);
    put(b.lowest);
    put(b.leafCount);
    put(b.highest);
    put(b.mask);
}
#ifdef BVH_INSTANCE
#define Block BvhInstance
void echo(BvhInstance b) { echoInstance(b); }
#else
#define Block BvhPlacement
void echo(BvhPlacement b)
{
    put(b.worldFromLocal);
    echoInstance(b.instance);
}
#endif

#elif defined(BVH_SCENE)

#define Block BvhScene
void echo(BvhScene b)
{
    put(b.instances);
    put(b.instanceCount);
    put(b.padding);
}

#elif defined(COUNTER_BLOCK)

#define Block CounterBlock
void echo(CounterBlock b)
{
    put(b.raysConsidered);
    put(b.raysTraced);
    put(b.cones);
    put(b.clampedPixels);
    put(b.nanPixels);
    put(b.infPixels);
    put(b.negativePixels);
    put(b.fallbackPixels);
    put(b.pieces);
    put(b.fieldEvaluations);
    put(b.lightVertices);
    put(b.silhouetteVertices);
}

#elif defined(CONE_CASE)

#define Block ConeCase
void echo(ConeCase b)
{
    put(b.position);
    put(b.normal);
    put(b.firstSphere);
    put(b.sphereCount);
    put(b.firstProbe);
    put(b.probeCount);
}

#elif defined(CONE_BLOCK)

#define Block ConeBlock
void echo(ConeBlock b)
{
    put(b.axis);
    put(b.chord);
    put(b.halfAngle);
    put(b.height);
    put(b.mergedHeight);
    put(b.kind);
    put(b.keeper);
}

#elif defined(PROBE_BLOCK)

#define Block ProbeBlock
void echo(ProbeBlock b)
{
    put(b.direction);
    put(b.isTraced);
    put(b.far);
}

#elif defined(CELL_BLOCK)

#define Block CellBlock
void echo(CellBlock b)
{
    for (int i = 0; i < b.radiance.length(); ++i)
        put(b.radiance[i]);
    for (int i = 0; i < b.fifthBand.length(); ++i)
        put(b.fifthBand[i]);
}

#elif defined(IRRADIANCE_CASE)

#define Block IrradianceCase
void echo(IrradianceCase b)
{
    put(b.position);
    put(b.normal);
    put(b.centre);
    put(b.radius);
    for (int i = 0; i < b.radianceSh.length(); ++i)
        put(b.radianceSh[i]);
}

#elif defined(FIELD_STEP_BLOCK)

#define Block FieldStepBlock
void echo(FieldStepBlock b)
{
    for (int i = 0; i < b.localFromWorld.length(); ++i)
        put(b.localFromWorld[i]);
    put(b.size);
    put(b.scale);
    put(b.blend);
    put(b.shape);
    put(b.operation);
    put(b.flags);
}

#elif defined(FIELD_GROUP_BLOCK)

#define Block FieldGroupBlock
void echo(FieldGroupBlock b)
{
    put(b.centre);
    put(b.reach);
    put(b.halfEdges);
    put(b.melt);
    put(b.slope);
    put(b.firstStep);
    put(b.endStep);
    put(b.field);
    put(b.takesAway);
}

#elif defined(FIELDS_BLOCK)

#define Block FieldsBlock
void echo(FieldsBlock b)
{
    put(b);
}

#elif defined(FIELD_SURFACE_BLOCK)

#define Block FieldSurfaceBlock
void echo(FieldSurfaceBlock b)
{
    put(b.albedo);
    put(b.roughness);
    put(b.metallic);
    put(b.specular);
}

#elif defined(FIELD_DRAW)

#define Block FieldDraw
void echo(FieldDraw b)
{
    put(b.fields);
    put(b.frame);
    put(b.extent);
    put(b.firstTile);
    put(b.tilesAcross);
}

#elif defined(FIELD_SHADE)

#define Block FieldShade
void echo(FieldShade b)
{
    put(b.fields);
    put(b.area);
    put(b.counters);
    put(b.seen);
    put(b.frame);
    put(b.depth);
    put(b.normals);
    put(b.cones);
    put(b.cells);
    put(b.rays);
    put(b.tolerance);
    put(b.pixelScale);
    put(b.litWidth);
    put(b.litHeight);
    put(b.albedo);
    put(b.seenGroups);
    put(b.firstByBones);
    put(b.endByBones);
}

#elif defined(FIELD_CASE)

#define Block FieldCase
void echo(FieldCase b)
{
    put(b.position);
    put(b.centre);
    put(b.radius);
    put(b.fields);
}

#elif defined(FIELD_ANSWER)

#define Block FieldAnswer
void echo(FieldAnswer b)
{
    put(b.visibility);
    put(b.evaluations);
}

#elif defined(EVAL_FIELD)

#define Block EvalField
void echo(EvalField b)
{
    put(b.cases);
    put(b.answers);
    put(b.caseCount);
    put(b.method);
    put(b.cones);
    put(b.tolerance);
}

#endif

layout(buffer_reference, scalar) readonly buffer Blocks { Block block[]; };

void main() { echo(Blocks(pc.inputs).block[1]); }
