// The structs of area lights have the same layout in C++ and in GLSL.
#include "gpu/shared_structs.h"

namespace antumbra {
namespace {

class AreaStructs : public SharedStructs
{
protected:
    AreaStructs() : SharedStructs("shared_structs_area.comp") {}
};

TEST_F(AreaStructs, BodyBlock)
{
    expectSameLayout<shader::BodyBlock>("BODY_BLOCK", [](const auto& b) {
        return wordsOf(b.centre, b.radius, b.firstVertex, b.vertexCount, b.firstFace, b.faceCount, b.firstEdge, b.edgeCount, b.flags,
                       b.margin);
    });
}

TEST_F(AreaStructs, FaceBlock)
{
    expectSameLayout<shader::FaceBlock>("FACE_BLOCK", [](const auto& b) { return wordsOf(b.normal, b.firstCorner, b.cornerCount); });
}

TEST_F(AreaStructs, EdgeBlock)
{
    expectSameLayout<shader::EdgeBlock>("EDGE_BLOCK", [](const auto& b) { return wordsOf(b.vertices, b.faces); });
}

TEST_F(AreaStructs, BodyArrays)
{
    expectSameLayout<shader::BodyArrays>("BODY_ARRAYS",
                                         [](const auto& b) { return wordsOf(b.bodies, b.vertices, b.faces, b.corners, b.edges); });
}

TEST_F(AreaStructs, AreaCase)
{
    expectSameLayout<shader::AreaCase>("AREA_CASE", [](const auto& b) {
        return wordsOf(b.position, b.normal, b.tangent, b.lobe, b.light, b.firstOccluder, b.occluderCount);
    });
}

TEST_F(AreaStructs, AreaAnswer)
{
    expectSameLayout<shader::AreaAnswer>("AREA_ANSWER", [](const auto& b) { return wordsOf(b.unoccluded, b.shadowed, b.fallbacks); });
}

TEST_F(AreaStructs, EvalArea)
{
    expectSameLayout<shader::EvalArea>("EVAL_AREA", [](const auto& b) {
        return wordsOf(b.arrays.bodies, b.arrays.vertices, b.arrays.faces, b.arrays.corners, b.arrays.edges, b.cases, b.answers, b.scratch,
                       b.caseCount, b.mostPieces);
    });
}

TEST_F(AreaStructs, AreaLightBlock)
{
    expectSameLayout<shader::AreaLightBlock>("AREA_LIGHT_BLOCK", [](const auto& b) { return wordsOf(b.radiance, b.body, b.light); });
}

TEST_F(AreaStructs, AreaTileBlock)
{
    expectSameLayout<shader::AreaTileBlock>("AREA_TILE_BLOCK", [](const auto& b) { return wordsOf(b.count, b.occluders); });
}

TEST_F(AreaStructs, AreaBlock)
{
    expectSameLayout<shader::AreaBlock>("AREA_BLOCK", [](const auto& b) {
        return wordsOf(b.arrays.bodies, b.arrays.vertices, b.arrays.faces, b.arrays.corners, b.arrays.edges, b.fields, b.lights, b.owners,
                       b.firstOccluder, b.occluderCount, b.lightCount, b.tilesAcross);
    });
}

TEST_F(AreaStructs, AreaTiles)
{
    expectSameLayout<shader::AreaTiles>("AREA_TILES",
                                        [](const auto& b) { return wordsOf(b.area, b.tiles, b.frame, b.depth, b.tileCount); });
}

TEST_F(AreaStructs, AreaProbe)
{
    expectSameLayout<shader::AreaProbe>("AREA_PROBE", [](const auto& b) {
        return wordsOf(b.area, b.lines, b.scratch, b.frame, b.depth, b.normals, b.albedo, b.mostPlanes, b.pixel.x, b.pixel.y);
    });
}

TEST_F(AreaStructs, ProbeLine)
{
    expectSameLayout<shader::ProbeLine>("PROBE_LINE", [](const auto& b) { return wordsOf(b.start, b.end, b.kind); });
}

TEST_F(AreaStructs, AreaShade)
{
    expectSameLayout<shader::AreaShade>("AREA_SHADE", [](const auto& b) {
        return wordsOf(b.area, b.tiles, b.counters, b.scene, b.shares, b.seenPastFields, b.frame, b.depth, b.normals, b.albedo, b.material,
                       b.ltcMatrix, b.ltcAmplitude, b.diffuse, b.specular, b.diffuseBefore, b.specularBefore, b.firstLight, b.endLight,
                       b.mostPieces, b.mostPlanes, b.rays, b.frameIndex, b.pixelScale);
    });
}

TEST_F(AreaStructs, AreaUpsample)
{
    expectSameLayout<shader::AreaUpsample>("AREA_UPSAMPLE", [](const auto& b) {
        return wordsOf(b.frame, b.depth, b.normals, b.diffuseLit, b.specularLit, b.diffuse, b.specular, b.pixelScale);
    });
}

TEST_F(AreaStructs, LightBodyDraw)
{
    expectSameLayout<shader::LightBodyDraw>("LIGHT_BODY_DRAW", [](const auto& b) {
        return wordsOf(b.worldFromLocal, b.positions, b.normals, b.radiance, b.exposure, b.frame, b.isTwoSided);
    });
}

TEST_F(AreaStructs, RatioSample)
{
    expectSameLayout<shader::RatioSample>("RATIO_SAMPLE", [](const auto& b) { return wordsOf(b.seen, b.whole, b.halfPenumbra); });
}

TEST_F(AreaStructs, RatioTrace)
{
    expectSameLayout<shader::RatioTrace>("RATIO_TRACE", [](const auto& b) {
        return wordsOf(b.area, b.scene, b.samples, b.frame, b.depth, b.normals, b.albedo, b.material, b.firstLight, b.endLight, b.rays,
                       b.pixelScale);
    });
}

TEST_F(AreaStructs, RatioDenoise)
{
    expectSameLayout<shader::RatioDenoise>("RATIO_DENOISE", [](const auto& b) {
        return wordsOf(b.samples, b.denoised, b.frame, b.depth, b.normals, b.lightCount, b.spacing, b.pixelScale);
    });
}

TEST_F(AreaStructs, ShadowRay)
{
    expectSameLayout<shader::ShadowRay>("SHADOW_RAY", [](const auto& b) { return wordsOf(b.halfPenumbra, b.blocker); });
}

TEST_F(AreaStructs, PenumbraTrace)
{
    expectSameLayout<shader::PenumbraTrace>("PENUMBRA_TRACE", [](const auto& b) {
        return wordsOf(b.area, b.scene, b.rays, b.frame, b.depth, b.normals, b.firstLight, b.endLight, b.pixelScale);
    });
}

TEST_F(AreaStructs, PenumbraSearch)
{
    expectSameLayout<shader::PenumbraSearch>("PENUMBRA_SEARCH", [](const auto& b) {
        return wordsOf(b.area, b.rays, b.shares, b.frame, b.depth, b.firstLight, b.endLight, b.pixelScale);
    });
}

} // namespace
} // namespace antumbra
