// The structs of shaders/shared/field.h have the same layout in C++ and in GLSL.
#include "gpu/shared_structs.h"

namespace antumbra {
namespace {

TEST_F(SharedStructs, FieldStepBlock)
{
    expectSameLayout<shader::FieldStepBlock>("FIELD_STEP_BLOCK", [](const auto& b) {
        return wordsOf(b.localFromWorld, b.size, b.scale, b.blend, b.shape, b.operation, b.flags);
    });
}

TEST_F(SharedStructs, FieldGroupBlock)
{
    expectSameLayout<shader::FieldGroupBlock>("FIELD_GROUP_BLOCK", [](const auto& b) {
        return wordsOf(b.centre, b.reach, b.halfEdges, b.melt, b.slope, b.firstStep, b.endStep, b.field, b.takesAway);
    });
}

TEST_F(SharedStructs, FieldsBlock)
{
    expectSameLayout<shader::FieldsBlock>(
        "FIELDS_BLOCK", [](const auto& b) { return wordsOf(b.steps, b.groups, b.surfaces, b.skipped, b.groupCount, b.takesAway); });
}

TEST_F(SharedStructs, FieldSurfaceBlock)
{
    expectSameLayout<shader::FieldSurfaceBlock>("FIELD_SURFACE_BLOCK",
                                                [](const auto& b) { return wordsOf(b.albedo, b.roughness, b.metallic, b.specular); });
}

TEST_F(SharedStructs, FieldDraw)
{
    expectSameLayout<shader::FieldDraw>("FIELD_DRAW",
                                        [](const auto& b) { return wordsOf(b.fields, b.frame, b.extent, b.firstTile, b.tilesAcross); });
}

TEST_F(SharedStructs, FieldShade)
{
    expectSameLayout<shader::FieldShade>("FIELD_SHADE", [](const auto& b) {
        return wordsOf(b.fields, b.area, b.counters, b.seen, b.frame, b.depth, b.normals, b.cones, b.cells, b.rays, b.tolerance,
                       b.pixelScale, b.litWidth, b.litHeight, b.albedo, b.seenGroups, b.firstByBones, b.endByBones);
    });
}

TEST_F(SharedStructs, FieldCase)
{
    expectSameLayout<shader::FieldCase>("FIELD_CASE", [](const auto& b) { return wordsOf(b.position, b.centre, b.radius, b.fields); });
}

TEST_F(SharedStructs, FieldAnswer)
{
    expectSameLayout<shader::FieldAnswer>("FIELD_ANSWER", [](const auto& b) { return wordsOf(b.visibility, b.evaluations); });
}

TEST_F(SharedStructs, EvalField)
{
    expectSameLayout<shader::EvalField>(
        "EVAL_FIELD", [](const auto& b) { return wordsOf(b.cases, b.answers, b.caseCount, b.method, b.cones, b.tolerance); });
}

} // namespace
} // namespace antumbra
