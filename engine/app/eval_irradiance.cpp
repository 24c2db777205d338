#include "app/eval.h"
#include "app/eval_cases.h"
#include "gpu/dispatch.h"
#include "render/shader_structs.h"
#include "render/shadow/samples.h"

#include <algorithm>
#include <cmath>

namespace antumbra::app {

namespace {

using nlohmann::json;

constexpr uint32_t kSampleCount = 4096;
constexpr double kShBasis0 = 0.2820947917738781; // 1 / (2 sqrt(pi))
constexpr scene::Range<float> kAnyRadiance{-1e9f, 1e9f};

bool isConstant(const EvalCase& each) { return each.object.object("env").text("type", "") == "const"; }

void readRadiance(const EvalCase& each, std::span<float, 9> radianceSh)
{
    constexpr scene::Words<bool, 2> kTypes{{{"const", true}, {"sh3", false}}};
    const scene::JsonObject environment = each.object.object("env");
    std::ranges::fill(radianceSh, 0.0f);
    if (environment.choice("type", std::optional<bool>(), kTypes)) {
        if (!environment.has("L"))
            environment.refuse("L", "is missing");
        radianceSh[0] = static_cast<float>(environment.number("L", 0, kAnyRadiance) / kShBasis0);
        return;
    }
    const json& coefficients = each.value["env"].value("coef", json());
    const auto isNumber = [](const json& value) { return value.is_number(); };
    if (!coefficients.is_array() || coefficients.size() != radianceSh.size() || !std::ranges::all_of(coefficients, isNumber))
        environment.refuse("coef", "expected 9 numbers in an array");
    for (size_t i = 0; i < radianceSh.size(); ++i)
        radianceSh[i] = coefficients[i].get<float>();
}

shader::IrradianceCase deviceCase(const EvalCase& each)
{
    if (!each.object.has("sphere"))
        each.object.refuse("sphere", "is missing");
    const EvalSphere sphere = sphereOf(each.object.object("sphere"));
    shader::IrradianceCase made{
        .position = each.vector("p"), .normal = each.unitVector("n"), .centre = sphere.centre, .radius = sphere.radius};
    readRadiance(each, made.radianceSh);
    return made;
}

void compare(const EvalCase& each, double occluded, Comparison& comparison)
{
    if (!each.object.has("E_occluded"))
        return;
    const double answer = each.object.number("E_occluded", 0, kAnyRadiance);
    const double unshadowed = each.object.number("E_unshadowed", 0, kAnyRadiance);
    comparison.add(each.id, std::abs(occluded - answer) / std::max(unshadowed, 0.3), isConstant(each) ? 0.005 : 0.01);
}

} // namespace

Evaluation evaluateIrradiance(gpu::Device& device, const Path& file)
{
    const EvalCases cases(file);
    const gpu::Pipeline pipeline = gpu::computePipeline(device, "eval_irradiance.comp");
    const std::vector<vec3> points = render::hemisphereSamples(kSampleCount);
    const gpu::Buffer samples = gpu::uploadedBuffer(device, "hemisphere samples", std::span<const vec3>(points));
    const gpu::Buffer occluded(device, "occluded irradiance", EvalCases::kBatch * sizeof(float), gpu::MemoryKind::Readback);

    Evaluation evaluation{.cases = cases.size()};
    json results = json::array();
    for (size_t first = 0; first < cases.size(); first += EvalCases::kBatch) {
        const std::span<const EvalCase> batch = cases.batch(first);
        std::vector<shader::IrradianceCase> blocks;
        for (const EvalCase& each : batch)
            blocks.push_back(deviceCase(each));
        const gpu::Buffer inputs = gpu::uploadedBuffer(device, "irradiance cases", std::span<const shader::IrradianceCase>(blocks));
        const auto count = static_cast<uint32_t>(batch.size());
        dispatchNow(device, pipeline,
                    shader::EvalIrradiance{.cases = inputs.address(),
                                           .samples = samples.address(),
                                           .occluded = occluded.address(),
                                           .caseCount = count,
                                           .sampleCount = kSampleCount},
                    count);
        const std::span<const float> found = gpu::mappedValues<const float>(occluded, count);
        for (size_t i = 0; i < batch.size(); ++i) {
            results.push_back({{"id", batch[i].id}, {"E_occluded", found[i]}});
            compare(batch[i], found[i], evaluation.comparison);
        }
    }
    evaluation.results = results.dump(1) + '\n';
    return evaluation;
}

} // namespace antumbra::app
