#include "app/eval.h"
#include "app/eval_cases.h"
#include "gpu/dispatch.h"
#include "render/shader_structs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace antumbra::app {

namespace {

using nlohmann::json;

constexpr double kTolerance = 1e-4;
constexpr double kMismatch = 1; // the error of a cone, a member or a probe that is not the answer's
constexpr scene::Range<float> kAnyValue{-1e10f, 1e10f};

/// The cases of one dispatch, flat.
struct Batch
{
    std::vector<shader::ConeCase> cases;
    std::vector<shader::SphereBlock> spheres;
    std::vector<shader::ProbeBlock> probes;
};

/// What the device made of one case.
struct Found
{
    std::span<const shader::ConeBlock> cones;
    std::span<const shader::ProbeBlock> probes;
    std::vector<uint32_t> kept; // the spheres whose cones are left after merging, in the order in which they absorb
};

void add(Batch& batch, const EvalCase& each)
{
    shader::ConeCase made{.position = each.vector("p"),
                          .normal = each.unitVector("n"),
                          .firstSphere = static_cast<uint32_t>(batch.spheres.size()),
                          .firstProbe = static_cast<uint32_t>(batch.probes.size())};
    if (!each.object.has("spheres"))
        each.object.refuse("spheres", "is missing");
    for (const scene::JsonObject& object : each.object.objects("spheres")) {
        const EvalSphere sphere = sphereOf(object);
        batch.spheres.push_back({.centre = sphere.centre, .radius = sphere.radius});
    }
    for (const scene::JsonObject& probe : each.object.objects("probes")) {
        if (!probe.has("dir"))
            probe.refuse("dir", "is missing");
        batch.probes.push_back({.direction = probe.vector("dir", vec3(0), kAnyValue)});
    }
    made.sphereCount = static_cast<uint32_t>(batch.spheres.size()) - made.firstSphere;
    made.probeCount = static_cast<uint32_t>(batch.probes.size()) - made.firstProbe;
    batch.cases.push_back(made);
}

bool isKept(const Found& found, uint32_t sphere)
{
    return found.cones[sphere].kind != shader::kConeNone && found.cones[sphere].keeper == sphere;
}

std::vector<uint32_t> keptInOrder(const Found& found)
{
    std::vector<uint32_t> kept;
    for (uint32_t sphere = 0; sphere < found.cones.size(); ++sphere)
        if (isKept(found, sphere))
            kept.push_back(sphere);
    std::ranges::stable_sort(kept, [&](uint32_t a, uint32_t b) {
        const shader::ConeBlock &first = found.cones[a], &second = found.cones[b];
        return first.kind != second.kind ? first.kind == shader::kConeAll : first.halfAngle > second.halfAngle;
    });
    return kept;
}

std::vector<uint32_t> membersOf(const Found& found, uint32_t keeper)
{
    std::vector<uint32_t> members;
    for (uint32_t sphere = 0; sphere < found.cones.size(); ++sphere)
        if (found.cones[sphere].kind != shader::kConeNone && found.cones[sphere].keeper == keeper)
            members.push_back(sphere);
    return members;
}

json toJson(const shader::ConeBlock& cone, float height)
{
    if (cone.kind == shader::kConeNone)
        return nullptr;
    return {{"all", cone.kind == shader::kConeAll}, {"d", {cone.axis.x, cone.axis.y, cone.axis.z}}, {"psi", cone.halfAngle}, {"h", height}};
}

json toJson(const EvalCase& each, const Found& found)
{
    json cones = json::array(), merged = json::array(), probes = json::array();
    for (const shader::ConeBlock& cone : found.cones)
        cones.push_back(toJson(cone, cone.height));
    for (const uint32_t keeper : found.kept) {
        merged.push_back(toJson(found.cones[keeper], found.cones[keeper].mergedHeight));
        merged.back()["members"] = membersOf(found, keeper);
    }
    for (const shader::ProbeBlock& probe : found.probes)
        probes.push_back(
            {{"dir", {probe.direction.x, probe.direction.y, probe.direction.z}}, {"trace", probe.isTraced != 0}, {"length", probe.far}});
    return {{"id", each.id}, {"cones", cones}, {"merged", merged}, {"probes", probes}};
}

// NaN would be lost among others in std::max.
double orWorst(double error) { return std::isnan(error) ? std::numeric_limits<double>::infinity() : error; }

double relativeError(double value, double answer) { return orWorst(std::abs(value - answer) / std::max(std::abs(answer), 1e-30)); }

double errorOf(const shader::ConeBlock& cone, float height, const scene::JsonObject& answer)
{
    if (cone.kind == shader::kConeNone || answer.flag("all", false) != (cone.kind == shader::kConeAll))
        return kMismatch;
    const double axis = glm::distance(glm::dvec3(cone.axis), glm::dvec3(answer.vector("d", vec3(0), kAnyValue)));
    return std::max({orWorst(axis), relativeError(cone.halfAngle, answer.number("psi", 0, kAnyValue)),
                     relativeError(height, answer.number("h", 0, kAnyValue))});
}

double conesError(const EvalCase& each, const Found& found)
{
    const std::vector<std::optional<scene::JsonObject>> answers = each.objectsOrNulls("cones");
    if (answers.size() != found.cones.size())
        each.object.refuse("cones", "expected an answer for each sphere");
    double error = 0;
    for (size_t i = 0; i < answers.size(); ++i) {
        const shader::ConeBlock& cone = found.cones[i];
        if (answers[i])
            error = std::max(error, errorOf(cone, cone.height, *answers[i]));
        else if (cone.kind != shader::kConeNone)
            error = kMismatch;
    }
    return error;
}

std::vector<uint32_t> answeredMembers(const json& answer)
{
    std::vector<uint32_t> members;
    for (const json& member : answer.value("members", json::array()))
        members.push_back(member.is_number_unsigned() ? member.get<uint32_t>() : std::numeric_limits<uint32_t>::max());
    std::ranges::sort(members);
    return members;
}

double mergedError(const EvalCase& each, const Found& found)
{
    const std::vector<scene::JsonObject> answers = each.object.objects("merged");
    if (answers.size() != found.kept.size())
        return kMismatch;
    double error = 0;
    for (size_t i = 0; i < answers.size(); ++i) {
        const shader::ConeBlock& cone = found.cones[found.kept[i]];
        const bool isSame = answeredMembers(each.value["merged"][i]) == membersOf(found, found.kept[i]);
        error = std::max({error, errorOf(cone, cone.mergedHeight, answers[i]), isSame ? 0 : kMismatch});
    }
    return error;
}

double probesError(const EvalCase& each, const Found& found)
{
    const std::vector<scene::JsonObject> answers = each.object.objects("probes");
    double error = 0;
    for (size_t i = 0; i < answers.size(); ++i) {
        const bool isTraced = found.probes[i].isTraced != 0;
        if (!answers[i].has("trace") || !answers[i].has("length_merged"))
            continue;
        if (answers[i].flag("trace", false) != isTraced)
            error = kMismatch;
        else if (isTraced)
            error = std::max(error, relativeError(found.probes[i].far, answers[i].number("length_merged", 0, kAnyValue)));
    }
    return error;
}

void compare(const EvalCase& each, const Found& found, Comparison& comparison)
{
    if (!each.object.has("cones") || !each.object.has("merged"))
        return;
    comparison.add(each.id, std::max({conesError(each, found), mergedError(each, found), probesError(each, found)}), kTolerance);
}

/// Buffers of one batch; an empty list has an address as well.
struct DeviceBatch
{
    DeviceBatch(gpu::Device& device, const Batch& batch)
        : cases(gpu::uploadedBuffer(device, "cone cases", std::span<const shader::ConeCase>(batch.cases))),
          spheres(gpu::uploadedBuffer(device, "spheres", std::span<const shader::SphereBlock>(batch.spheres))),
          cones(device, "cones", (batch.spheres.size() + 1) * sizeof(shader::ConeBlock), gpu::MemoryKind::Readback),
          probes(device, "probes", (batch.probes.size() + 1) * sizeof(shader::ProbeBlock), gpu::MemoryKind::Readback)
    {
        gpu::upload(device, probes, std::as_bytes(std::span(batch.probes)));
    }

    gpu::Buffer cases, spheres, cones, probes;
};

Found foundOf(const DeviceBatch& device, const shader::ConeCase& at)
{
    const size_t spheres = at.firstSphere + at.sphereCount, probes = at.firstProbe + at.probeCount;
    Found found{.cones = gpu::mappedValues<const shader::ConeBlock>(device.cones, spheres).subspan(at.firstSphere),
                .probes = gpu::mappedValues<const shader::ProbeBlock>(device.probes, probes).subspan(at.firstProbe),
                .kept = {}};
    found.kept = keptInOrder(found);
    return found;
}

} // namespace

Evaluation evaluateCones(gpu::Device& device, const Path& file)
{
    const EvalCases cases(file);
    const gpu::Pipeline pipeline = gpu::computePipeline(device, "eval_cones.comp");
    Evaluation evaluation{.cases = cases.size()};
    json results = json::array();
    for (size_t first = 0; first < cases.size(); first += EvalCases::kBatch) {
        const std::span<const EvalCase> evalCases = cases.batch(first);
        Batch batch;
        for (const EvalCase& each : evalCases)
            add(batch, each);
        const DeviceBatch buffers(device, batch);
        const auto count = static_cast<uint32_t>(evalCases.size());
        dispatchNow(device, pipeline,
                    shader::EvalCones{.cases = buffers.cases.address(),
                                      .spheres = buffers.spheres.address(),
                                      .cones = buffers.cones.address(),
                                      .probes = buffers.probes.address(),
                                      .caseCount = count},
                    count);
        for (size_t i = 0; i < evalCases.size(); ++i) {
            const Found found = foundOf(buffers, batch.cases[i]);
            results.push_back(toJson(evalCases[i], found));
            compare(evalCases[i], found, evaluation.comparison);
        }
    }
    evaluation.results = results.dump(1) + '\n';
    return evaluation;
}

} // namespace antumbra::app
