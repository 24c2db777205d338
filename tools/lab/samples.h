// Figures by name, as many values each as were measured.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace antumbra::lab {

/// A quantity, one value a frame or a bake.
struct Series
{
    std::string name;
    std::vector<double> values;
};

/// What was measured, in the order in which it first was.
struct Samples
{
    std::vector<Series> times; // milliseconds; a time that cannot be had has no value
    std::vector<Series> counters;

    void append(const Samples& more);
};

void push(std::vector<Series>& series, std::string_view name, std::optional<double> value);

} // namespace antumbra::lab
