// Area problems through shaders/eval_area.comp, many at a time. Keeps its pipeline and memory from one batch to the next.
#pragma once

#include "app/area_problem.h"
#include "gpu/buffer.h"
#include "gpu/pipeline.h"

#include <array>

namespace antumbra {

constexpr uint32_t kAllPieces = 1u << 20; // none is left to samples

class AreaRunner
{
public:
    explicit AreaRunner(gpu::Device& device);

    /// One answer a problem, filled with NaN before the device writes them. `mostPieces` as EvalArea has it. Bodies are given to the
    /// device in a space that `toWorld` takes to the problem's: its inverse must be exact.
    std::vector<shader::AreaAnswer> run(std::span<const app::AreaProblem> problems, uint32_t mostPieces = kAllPieces,
                                        const mat4& toWorld = mat4{1});
    shader::AreaAnswer run(const app::AreaProblem& problem, uint32_t mostPieces = kAllPieces) { return run({&problem, 1}, mostPieces)[0]; }

private:
    template <class T>
    uint64_t put(size_t slot, const std::vector<T>& values);

    gpu::Device& device_;
    gpu::Pipeline pipeline_;
    std::array<gpu::Buffer, 6> inputs_;
    gpu::Buffer answers_;
    gpu::Buffer scratch_; // where threads have no room of their own
    render::BodyBlocks bodies_;
    std::vector<shader::AreaCase> cases_;
};

} // namespace antumbra
