// The processes that bake together, as the baker sees them: which one this is, and how they tell each other what is done. Knows
// nothing of how they are started and how they talk; by default one is alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace antumbra::bake {

using Bytes = std::vector<std::byte>;

struct Peers
{
    uint32_t rank = 0; // the first reports and keeps what is done
    uint32_t count = 1;
    /// Called by all of them at the same points: each gives its bytes and gets everyone's, in the order of ranks. Throws Error where one
    /// of them is gone.
    std::function<std::vector<Bytes>(Bytes)> exchange = [](Bytes mine) {
        std::vector<Bytes> all;
        all.push_back(std::move(mine));
        return all;
    };
};

} // namespace antumbra::bake
