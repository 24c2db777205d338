// Work that is dealt out over threads, told of, and interrupted. Units of a round must not need each other's results.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace antumbra::fit {

class Rounds
{
public:
    /// `workAll`: of all rounds to come, in any unit. `report` and `isInterrupted` may be empty; the calling thread calls them.
    Rounds(uint32_t threads, double workAll, std::function<void(double share)> report, std::function<bool()> isInterrupted);

    /// All units are done, or false: interrupted, now or before.
    bool finish(uint32_t units, double workOfUnit, const std::function<void(uint32_t unit)>& work);

private:
    uint32_t threads_;
    double workAll_, workDone_ = 0;
    std::function<void(double)> report_;
    std::function<bool()> isInterrupted_;
    std::atomic<bool> isOver_{false};
};

} // namespace antumbra::fit
