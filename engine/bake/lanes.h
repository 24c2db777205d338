// Sixteen rays' numbers side by side, for arithmetic that the compiler turns into vector instructions of whatever width there is. Passed by
// reference, so that no calling convention depends on that width.
#pragma once

#include <cstdint>

namespace antumbra::bake {

inline constexpr uint32_t kLanes = 16;

using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

/// Four numbers of one vector of coefficients.
using Four = float __attribute__((vector_size(4 * sizeof(float))));

/// Bit i stands for lane i.
using LaneMask = uint32_t;

inline constexpr LaneMask kAllLanes = (1u << kLanes) - 1;

inline bool isSet(LaneMask mask, uint32_t lane) { return (mask >> lane & 1u) != 0; }

/// 1 in the lanes of `mask`, else 0.
inline void setWeights(LaneMask mask, Lanes& weights)
{
    for (uint32_t lane = 0; lane < kLanes; ++lane)
        weights[lane] = isSet(mask, lane) ? 1.0f : 0.0f;
}

inline float sumOf(const Lanes& lanes)
{
    float sum = 0;
    for (uint32_t lane = 0; lane < kLanes; ++lane)
        sum += lanes[lane];
    return sum;
}

} // namespace antumbra::bake
