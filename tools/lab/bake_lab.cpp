#include "tools/lab/bake_lab.h"

#include "tools/lab/bake_bench.h"

#include <fmt/format.h>

namespace antumbra::lab {

namespace {

constexpr std::string_view kColumns[] = {"bake", "bounce, some texels"};

} // namespace

BakeLab::BakeLab(app::Sweep sweep, const Path& folder, bool resumes)
    : sweep_(std::move(sweep)), record_({.sweep = sweep_.name, .device = {}, .rows = {}}, folder)
{
    for (const app::SweepPoint& point : sweep_.points)
        record_.results.rows.push_back({.point = point, .knobs = BakeBench::knobsOf(point)});
    if (resumes)
        record_.resumeFromDisk();
}

bool BakeLab::run()
{
    const bool isDone = measureAll();
    record_.finish(kColumns);
    return isDone;
}

bool BakeLab::measureAll()
{
    for (uint32_t round = 0; round < sweep_.repeats; ++round)
        for (Row& row : record_.results.rows) {
            if (row.rounds > round)
                continue;
            progress_.tell(fmt::format("round {} of {}: {}", round + 1, sweep_.repeats, row.point.name));
            if (!measure(row))
                return false;
        }
    return true;
}

bool BakeLab::measure(Row& row)
{
    BakeBench bench(row.point);
    const std::optional<Samples> samples = bench.measure(interrupt_);
    if (!samples)
        return false;
    row.samples.append(*samples);
    ++row.rounds;
    if (row.point.referenceSamples > 0 && !row.error)
        row.error = bench.error();
    record_.save();
    return true;
}

} // namespace antumbra::lab
