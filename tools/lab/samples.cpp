#include "tools/lab/samples.h"

#include <algorithm>

namespace antumbra::lab {

namespace {

std::vector<double>& valuesOf(std::vector<Series>& series, std::string_view name)
{
    const auto found = std::ranges::find(series, name, &Series::name);
    return found != series.end() ? found->values : series.emplace_back(Series{std::string(name), {}}).values;
}

void appendAll(std::vector<Series>& to, const std::vector<Series>& from)
{
    for (const Series& series : from) {
        std::vector<double>& values = valuesOf(to, series.name);
        values.insert(values.end(), series.values.begin(), series.values.end());
    }
}

} // namespace

void push(std::vector<Series>& series, std::string_view name, std::optional<double> value)
{
    std::vector<double>& values = valuesOf(series, name);
    if (value)
        values.push_back(*value);
}

void Samples::append(const Samples& more)
{
    appendAll(times, more.times);
    appendAll(counters, more.counters);
}

} // namespace antumbra::lab
