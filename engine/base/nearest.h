// Which known word somebody probably meant. For messages only: nothing is ever corrected silently.
#pragma once

#include <span>
#include <string_view>

namespace antumbra {

/// The word of `known` (not empty) with the fewest insertions, deletions and replacements of letters; the first of equals.
std::string_view nearestWord(std::string_view word, std::span<const std::string_view> known);

} // namespace antumbra
