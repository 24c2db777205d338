// Fits the tables of bake/ltc.h to the GGX reflection. The result does not depend on the number of threads. Writes no files.
#pragma once

#include "bake/ltc.h"

#include <functional>
#include <optional>

namespace antumbra::fit {

struct FitJob
{
    uint32_t size = 64;                       // texels a side, 2 or more
    uint32_t threads = 1;                     // 1 or more
    std::function<void(double share)> report; // 0..1, from the calling thread
    std::function<bool()> isInterrupted;      // asked from the calling thread
};

/// Nothing where it was interrupted.
std::optional<bake::LtcTables> fitTables(const FitJob& job);

} // namespace antumbra::fit
