#include "gpu/area_runner.h"

#include "gpu/dispatch.h"

#include <algorithm>
#include <cstring>

namespace antumbra {

namespace {

constexpr size_t kLeastBytes = 1 << 16;

/// What a growing buffer must hold: half as much again, so that it seldom grows.
size_t roomFor(size_t bytes) { return std::max(kLeastBytes, bytes + bytes / 2); }

/// The bodies where `toWorld` has yet to move them.
app::AreaProblem movedBack(const app::AreaProblem& problem, const mat4& toWorld)
{
    const mat4 fromWorld = glm::inverse(toWorld);
    app::AreaProblem moved = problem;
    moved.light = scene::transformed(moved.light, fromWorld);
    for (app::AreaOccluder& occluder : moved.occluders)
        occluder.body = scene::transformed(occluder.body, fromWorld);
    return moved;
}

} // namespace

AreaRunner::AreaRunner(gpu::Device& device) : device_(device), pipeline_(app::areaPipeline(device)) {}

template <class T>
uint64_t AreaRunner::put(size_t slot, const std::vector<T>& values)
{
    const size_t bytes = values.size() * sizeof(T);
    gpu::Buffer& buffer = inputs_[slot];
    if (buffer.bytes() < std::max(bytes, kLeastBytes))
        buffer = gpu::Buffer(device_, "area inputs", roomFor(bytes), gpu::MemoryKind::Upload);
    if (bytes > 0)
        std::memcpy(buffer.mapped(), values.data(), bytes);
    return buffer.address();
}

std::vector<shader::AreaAnswer> AreaRunner::run(std::span<const app::AreaProblem> problems, uint32_t mostPieces, const mat4& toWorld)
{
    bodies_.clear();
    cases_.clear();
    for (const app::AreaProblem& problem : problems)
        cases_.push_back(toWorld == mat4{1} ? deviceCase(problem, bodies_) : deviceCase(movedBack(problem, toWorld), bodies_, toWorld));
    const size_t bytes = problems.size() * sizeof(shader::AreaAnswer);
    if (answers_.bytes() < std::max(bytes, kLeastBytes))
        answers_ = gpu::Buffer(device_, "area answers", roomFor(bytes), gpu::MemoryKind::Readback);
    std::memset(answers_.mapped(), 0xff, bytes);
    if (scratch_.bytes() < problems.size() * shader::kAreaScratchBytes)
        scratch_ = app::areaScratch(device_, problems.size());
    const auto count = static_cast<uint32_t>(problems.size());
    const shader::EvalArea push{
        .arrays = {put(0, bodies_.bodies), put(1, bodies_.vertices), put(2, bodies_.faces), put(3, bodies_.corners), put(4, bodies_.edges)},
        .cases = put(5, cases_),
        .answers = answers_.address(),
        .scratch = scratch_.address(),
        .caseCount = count,
        .mostPieces = mostPieces};
    gpu::dispatchNow(device_, pipeline_, push, count);
    const auto found = gpu::mappedValues<const shader::AreaAnswer>(answers_, count);
    return {found.begin(), found.end()};
}

} // namespace antumbra
