// What a run of the lab keeps on disk and tells on the screen. Measures nothing.
#pragma once

#include "tools/lab/results.h"

#include <chrono>

namespace antumbra::lab {

/// As in "1:07".
std::string minutes(double seconds);

/// Lines on stderr, not too many.
class Progress
{
public:
    void tell(const std::string& line);

private:
    std::chrono::steady_clock::time_point told_{};
};

/// The results of a sweep as they grow.
class Record
{
public:
    Results results;

    /// They lie in FOLDER/NAME.json and .csv.
    Record(Results begun, Path folder) : results(std::move(begun)), folder_(std::move(folder)) {}

    /// Goes on from the results that lie there, if any do. Throws Error for those of something else.
    void resumeFromDisk();
    void save() const;
    /// Saves, and prints the table of `columns`, names of times, and where all the rest is.
    void finish(std::span<const std::string_view> columns) const;

private:
    [[nodiscard]] Path file(std::string_view extension) const;

    Path folder_;
};

} // namespace antumbra::lab
