// How much of Embree's own rate a bake keeps: some of its texels and cells, gathered in turn with Embree alone on the same rays, on one
// thread.
#pragma once

#include "bake/gather.h"

namespace antumbra::lab {

/// What a part of the bake takes, with the baker and without.
struct Paired
{
    double bakerMilliseconds = 0;
    double aloneMilliseconds = 0;

    [[nodiscard]] double share() const { return aloneMilliseconds / bakerMilliseconds; }
};

struct BakeShare
{
    Paired direct, bounce, volume; // as measured
    Paired all;                    // of the whole bake, by how much of each there is in it
    uint32_t texels = 0;           // of the whole bake
};

BakeShare measureShare(const bake::StaticScene& surfaces, const bake::Grid& grid, const bake::BakeSettings& settings);

} // namespace antumbra::lab
