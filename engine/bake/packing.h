// Rectangles side by side on one page, none on another. Knows not what they hold.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace antumbra::bake {

struct Packing
{
    uvec2 page{0};              // sides are multiples of four
    std::vector<uvec2> corners; // the lowest of every rectangle
};

/// On the smallest page found, of at most `mostTexels` (4 at least) a side; nothing where they do not fit.
std::optional<Packing> pack(std::span<const uvec2> rectangles, uint32_t mostTexels);

/// Whether pack() finds a page; sooner.
bool fits(std::span<const uvec2> rectangles, uint32_t mostTexels);

} // namespace antumbra::bake
