// Each struct of shaders/shared has the same layout in C++ and in GLSL.
#include "gpu/shared_structs.h"

namespace antumbra {
namespace {

TEST_F(SharedStructs, FrameBlock)
{
    expectSameLayout<shader::FrameBlock>("FRAME_BLOCK", [](const auto& b) {
        return wordsOf(b.clipFromWorld, b.eye, b.cornerRay, b.rayX, b.rayY, b.near, b.environment, b.environmentTurn,
                       b.environmentIntensity, b.radianceSh, b.irradianceSh, b.baked.texels, b.baked.cells, b.baked.origin,
                       b.baked.cellsPerMetre, b.baked.lastCell, b.baked.lastTexel, b.baked.outside, b.baked.sentOn);
    });
}

TEST_F(SharedStructs, GBufferDraw)
{
    expectSameLayout<shader::GBufferDraw>("GBUFFER_DRAW", [](const auto& b) {
        return wordsOf(b.worldFromLocal, b.material.albedo, b.material.alphaCutoff, b.material.alpha, b.material.roughness,
                       b.material.metallic, b.material.specular, b.material.albedoImage, b.material.metallicRoughnessImage, b.positions,
                       b.normals, b.uvs, b.bakeUvs, b.frame, b.flags);
    });
}

TEST_F(SharedStructs, CellBlock)
{
    expectSameLayout<shader::CellBlock>("CELL_BLOCK", [](const auto& b) { return wordsOf(b.radiance, b.fifthBand); });
}

TEST_F(SharedStructs, MaterialBlock)
{
    expectSameLayout<shader::MaterialBlock>("MATERIAL_BLOCK", [](const auto& b) {
        return wordsOf(b.albedo, b.alphaCutoff, b.alpha, b.roughness, b.metallic, b.specular, b.albedoImage, b.metallicRoughnessImage);
    });
}

TEST_F(SharedStructs, InfluenceBlock)
{
    expectSameLayout<shader::InfluenceBlock>("INFLUENCE_BLOCK", [](const auto& b) { return wordsOf(b.joints01, b.joints23, b.weights); });
}

TEST_F(SharedStructs, MorphBlock)
{
    expectSameLayout<shader::MorphBlock>("MORPH_BLOCK",
                                         [](const auto& b) { return wordsOf(b.firstVertex, b.count, b.positions, b.normals); });
}

TEST_F(SharedStructs, BoneBlock)
{
    expectSameLayout<shader::BoneBlock>("BONE_BLOCK",
                                        [](const auto& b) { return wordsOf(b.a, b.firstVertex, b.b, b.vertexCount, b.joint); });
}

TEST_F(SharedStructs, CapsuleBlock)
{
    expectSameLayout<shader::CapsuleBlock>("CAPSULE_BLOCK", [](const auto& b) { return wordsOf(b.middle, b.radius, b.arm, b.reach); });
}

TEST_F(SharedStructs, SphereBlock)
{
    expectSameLayout<shader::SphereBlock>("SPHERE_BLOCK", [](const auto& b) { return wordsOf(b.centre, b.radius); });
}

TEST_F(SharedStructs, BlockerBlock)
{
    expectSameLayout<shader::BlockerBlock>("BLOCKER_BLOCK",
                                           [](const auto& b) { return wordsOf(b.centre, b.radius, b.firstCapsule, b.capsuleCount); });
}

TEST_F(SharedStructs, BlockerSource)
{
    expectSameLayout<shader::BlockerSource>("BLOCKER_SOURCE", [](const auto& b) {
        return wordsOf(b.worldFromLocal, b.sphere, b.capsules, b.firstCapsule, b.capsuleCount, b.scale, b.padding);
    });
}

TEST_F(SharedStructs, GroundBlock)
{
    expectSameLayout<shader::GroundBlock>("GROUND_BLOCK", [](const auto& b) { return wordsOf(b.centre, b.radius, b.height, b.missed); });
}

TEST_F(SharedStructs, OcclusionTrace)
{
    expectSameLayout<shader::OcclusionTrace>("OCCLUSION_TRACE", [](const auto& b) {
        return wordsOf(b.scene, b.samples, b.counters, b.blockers, b.capsules, b.fields, b.grounds, b.frame, b.depth, b.normals, b.occluded,
                       b.isFiltered, b.sampleCount, b.blockerCount, b.groundCount, b.tolerance, b.pixelScale, b.frameIndex, b.padding);
    });
}

TEST_F(SharedStructs, BvhNode)
{
    expectSameLayout<shader::BvhNode>("BVH_NODE",
                                      [](const auto& b) { return wordsOf(b.lowest, b.firstTriangle, b.highest, b.triangleCount); });
}

Words instanceWords(const shader::BvhInstance& b)
{
    return wordsOf(b.localFromWorld, b.nodes, b.positions, b.indices, b.lowest, b.leafCount, b.highest, b.mask);
}

TEST_F(SharedStructs, BvhInstance) { expectSameLayout<shader::BvhInstance>("BVH_INSTANCE", instanceWords); }

TEST_F(SharedStructs, BvhPlacement)
{
    expectSameLayout<shader::BvhPlacement>("BVH_PLACEMENT", [](const auto& b) {
        Words words = wordsOf(b.worldFromLocal);
        const Words instance = instanceWords(b.instance);
        words.insert(words.end(), instance.begin(), instance.end());
        return words;
    });
}

TEST_F(SharedStructs, BvhScene)
{
    expectSameLayout<shader::BvhScene>("BVH_SCENE", [](const auto& b) { return wordsOf(b.instances, b.instanceCount, b.padding); });
}

TEST_F(SharedStructs, CounterBlock)
{
    expectSameLayout<shader::CounterBlock>("COUNTER_BLOCK", [](const auto& b) {
        return wordsOf(b.raysConsidered, b.raysTraced, b.cones, b.clampedPixels, b.nanPixels, b.infPixels, b.negativePixels,
                       b.fallbackPixels, b.pieces, b.fieldEvaluations, b.lightVertices, b.silhouetteVertices);
    });
}

TEST_F(SharedStructs, ConeCase)
{
    expectSameLayout<shader::ConeCase>(
        "CONE_CASE", [](const auto& b) { return wordsOf(b.position, b.normal, b.firstSphere, b.sphereCount, b.firstProbe, b.probeCount); });
}

TEST_F(SharedStructs, ConeBlock)
{
    expectSameLayout<shader::ConeBlock>(
        "CONE_BLOCK", [](const auto& b) { return wordsOf(b.axis, b.chord, b.halfAngle, b.height, b.mergedHeight, b.kind, b.keeper); });
}

TEST_F(SharedStructs, ProbeBlock)
{
    expectSameLayout<shader::ProbeBlock>("PROBE_BLOCK", [](const auto& b) { return wordsOf(b.direction, b.isTraced, b.far); });
}

TEST_F(SharedStructs, IrradianceCase)
{
    expectSameLayout<shader::IrradianceCase>("IRRADIANCE_CASE",
                                             [](const auto& b) { return wordsOf(b.position, b.normal, b.centre, b.radius, b.radianceSh); });
}

} // namespace
} // namespace antumbra
