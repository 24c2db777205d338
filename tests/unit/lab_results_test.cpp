// The lab's results as CSV: what tables read must be a table.
#include "tools/lab/results.h"

#include <gtest/gtest.h>

namespace antumbra::lab {
namespace {

/// The cells of a line: commas part them where they stand outside of quotes.
size_t cellsIn(std::string_view line)
{
    size_t cells = 1;
    bool isQuoted = false;
    for (const char c : line) {
        isQuoted = isQuoted != (c == '"');
        cells += c == ',' && !isQuoted ? 1 : 0;
    }
    return cells;
}

TEST(LabResults, RowsHaveACellForEveryNameWhateverIsInTheNames)
{
    Results results{.sweep = "s", .device = {}, .rows = {Row{.point = {.name = "half, and half", .scene = "plaza"}, .rounds = 2}}};
    results.rows[0].samples.times = {{"area traced, quads", {1, 2, 3}}, {"frame", {4}}};
    results.rows[0].samples.counters = {{"rays, all", {5}}};
    const std::string csv = csvOf(results);
    const size_t end = csv.find('\n');
    const std::string head = csv.substr(0, end), row = csv.substr(end + 1, csv.find('\n', end + 1) - end - 1);
    EXPECT_EQ(cellsIn(head), cellsIn(row));
    EXPECT_NE(head.find("\"area traced, quads ms median\""), std::string::npos) << head;
    EXPECT_NE(row.find(",1.5,2,2.5,4,4,4,5,5,5"), std::string::npos) << row;
}

} // namespace
} // namespace antumbra::lab
