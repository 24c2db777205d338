#include "app/area_problem.h"
#include "app/eval.h"
#include "gpu/dispatch.h"
#include "render/body_blocks.h"

#include <cmath>

namespace antumbra::app {

namespace {

using nlohmann::json;

constexpr uint32_t kMostPieces = 1u << 20; // none is left to samples

/// The distance to the nearer end of what is allowed, in units of the case's tolerance: both shares near their answers, and 0 <= shadowed
/// <= unoccluded to a millionth.
void compare(const EvalCase& each, const shader::AreaAnswer& found, Comparison& comparison)
{
    if (!each.object.has("expected"))
        return;
    const scene::JsonObject expected = each.object.object("expected");
    constexpr scene::Range<float> kAnyShare{-1e9f, 1e9f};
    const auto answer = [&](const char* key) -> double {
        if (!expected.has(key))
            expected.refuse(key, "is missing");
        return double{expected.number(key, 0, kAnyShare)};
    };
    const double tolerance = double{each.object.number("tolerance_abs", 1e-5f, {0, 1})};
    const double off = std::max(std::abs(found.unoccluded - answer("unoccluded")), std::abs(found.shadowed - answer("shadowed")));
    const bool isWithin = found.shadowed >= -1e-6f && found.shadowed <= found.unoccluded + 1e-6f;
    comparison.add(each.id, isWithin ? off : std::max(off, 1.0), tolerance);
}

std::vector<shader::AreaAnswer> answersOf(gpu::Device& device, const gpu::Pipeline& pipeline, std::span<const EvalCase> batch)
{
    render::BodyBlocks bodies;
    std::vector<shader::AreaCase> cases;
    for (const EvalCase& each : batch)
        cases.push_back(deviceCase(areaProblemOf(each), bodies));
    const auto uploaded = [&]<class T>(const std::vector<T>& values) {
        return gpu::uploadedBuffer(device, "area cases", std::span<const T>(values));
    };
    const gpu::Buffer inputs = uploaded(cases), bodyBlocks = uploaded(bodies.bodies), vertices = uploaded(bodies.vertices),
                      faces = uploaded(bodies.faces), corners = uploaded(bodies.corners), edges = uploaded(bodies.edges);
    const gpu::Buffer answers(device, "area answers", EvalCases::kBatch * sizeof(shader::AreaAnswer), gpu::MemoryKind::Readback);
    const gpu::Buffer scratch = areaScratch(device, batch.size());
    const auto count = static_cast<uint32_t>(batch.size());
    dispatchNow(device, pipeline,
                shader::EvalArea{.arrays = {bodyBlocks.address(), vertices.address(), faces.address(), corners.address(), edges.address()},
                                 .cases = inputs.address(),
                                 .answers = answers.address(),
                                 .scratch = scratch.address(),
                                 .caseCount = count,
                                 .mostPieces = kMostPieces},
                count);
    const auto found = gpu::mappedValues<const shader::AreaAnswer>(answers, count);
    return {found.begin(), found.end()};
}

} // namespace

Evaluation evaluateArea(gpu::Device& device, const Path& file)
{
    const EvalCases cases(file);
    const gpu::Pipeline pipeline = areaPipeline(device);
    Evaluation evaluation{.cases = cases.size()};
    json results = json::array();
    for (size_t first = 0; first < cases.size(); first += EvalCases::kBatch) {
        const std::span<const EvalCase> batch = cases.batch(first);
        const std::vector<shader::AreaAnswer> answers = answersOf(device, pipeline, batch);
        for (size_t i = 0; i < batch.size(); ++i) {
            results.push_back({{"id", batch[i].id}, {"shadowed", answers[i].shadowed}, {"unoccluded", answers[i].unoccluded}});
            compare(batch[i], answers[i], evaluation.comparison);
        }
    }
    evaluation.results = results.dump(1) + '\n';
    return evaluation;
}

} // namespace antumbra::app
