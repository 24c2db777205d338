#include "base/nearest.h"

#include "base/check.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace antumbra {

namespace {

// Levenshtein's distance, one row of the table at a time.
size_t editDistance(std::string_view a, std::string_view b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string_view nearestWord(std::string_view word, std::span<const std::string_view> known)
{
    check(!known.empty(), "at least one known word");
    return *std::ranges::min_element(known, {}, [word](std::string_view candidate) { return editDistance(word, candidate); });
}

} // namespace antumbra
