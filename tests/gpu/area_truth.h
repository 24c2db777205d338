// The share of an area light by rays alone: no planes, no silhouettes, no convexity, nothing of the method's.
#pragma once

#include "gpu/area_twin.h"
#include "gpu/random_inputs.h"

namespace antumbra {

struct SampledShares
{
    AreaShares shares, standardErrors;
};

/// `batches` runs of gridSize^2 directions, stratified over the lobe; the error is that of the runs' mean, by their spread.
SampledShares sampledShares(const app::AreaProblem& problem, uint32_t gridSize, uint32_t batches, RandomInputs& random);

} // namespace antumbra
