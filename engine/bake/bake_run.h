// Runs the passes of a bake, tile by tile: over threads, over processes, interrupted and resumed. Knows nothing of light.
#pragma once

#include "bake/baker.h"
#include "bake/gather.h"
#include "bake/partial_file.h"

#include <chrono>

namespace antumbra::bake {

/// Texels or cells, each of which is gathered by itself into a place of its own.
struct Pass
{
    std::string stage;
    uint32_t units = 0; // texels or cells
    uint32_t raysPerUnit = 1;
    std::vector<vec3>* values = nullptr;   // as many a unit as there are
    std::vector<uint8_t>* flags = nullptr; // one a unit
    std::function<void(Range)> gather;     // by any number of threads at a time

    [[nodiscard]] uint32_t tileCount() const;
    [[nodiscard]] Range rangeOf(uint32_t tile) const;
};

class BakeRun
{
public:
    /// `job` must outlive it. `raysAll`: of all passes to come.
    BakeRun(const BakeJob& job, uint64_t sceneHash, const BakeSettings& settings, uint64_t raysAll);

    /// All of the pass is done in all processes, or false: somebody interrupted. Called for the same passes in the same order always.
    bool finish(const Pass& pass);

private:
    using Clock = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;

    void restore(const Pass& pass);
    void apply(const Pass& pass, std::span<const std::byte> records);
    [[nodiscard]] std::vector<uint32_t> shareOf(const Pass& pass) const;
    size_t gather(const Pass& pass, std::span<const uint32_t> tiles);
    [[nodiscard]] Seconds roundOf(const Pass& pass) const;
    [[nodiscard]] double raysPerSecond(uint64_t raysDone) const; // since the start, with so many done
    bool isRoundOver();
    bool exchange(const Pass& pass, std::span<const uint32_t> finished);
    void report(const Pass& pass, uint64_t raysOfRound);

    const BakeJob& job_;
    uint32_t threads_;
    std::optional<PartialFile> partial_; // of the first process
    uint32_t index_ = 0;                 // of the pass
    std::vector<uint8_t> isDone_;        // one a tile of the pass, in any process
    bool isInterrupted_ = false;
    uint64_t raysAll_;
    uint64_t raysDone_ = 0; // known to all processes
    uint64_t raysRestored_ = 0;
    Clock::time_point started_ = Clock::now();
    Clock::time_point roundEnd_{};
    Clock::time_point reported_{};
};

} // namespace antumbra::bake
