// The lab's results: rows that grow with every round, as JSON to read on from and as CSV to look at.
#pragma once

#include "app/measure.h"
#include "app/sweep.h"
#include "gpu/device.h"
#include "tools/lab/samples.h"

#include <span>

namespace antumbra::lab {

/// What is known of one point.
struct Row
{
    app::SweepPoint point;
    render::Settings knobs; // all of them
    uint32_t rounds = 0;    // that are in `samples`
    Samples samples;
    std::optional<app::ImageError> error;
};

struct Results
{
    std::string sweep;
    std::optional<gpu::DeviceInfo> device; // nothing: the processor alone was measured
    std::vector<Row> rows;
};

/// One line a row, after a line of names: lower quartile, median and upper quartile of every time and counter. What a row lacks is empty.
std::string csvOf(const Results& results);
/// The same with every value, and what was measured on.
std::string jsonOf(const Results& results);

/// Takes over what `file`, as jsonOf() wrote it, knows of the rows. Throws Error where it is of another sweep or another device.
void resume(Results& results, const Path& file);

/// How well what was asked for fits, in a line; rows that lack a figure are left out. Throws Error as fitLinear() does.
std::string fitOf(const Results& results, const app::SweepFit& fit);

/// Medians of the times that `columns` names, as far as some row has them, and the error, a line a row.
std::string tableOf(const Results& results, std::span<const std::string_view> columns);

} // namespace antumbra::lab
