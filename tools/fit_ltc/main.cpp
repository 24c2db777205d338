// fit_ltc: the tables of linearly transformed cosines, and their errors beside another's (DESIGN.md, Commands).
#include "app/interrupt.h"
#include "base/error.h"
#include "base/log.h"
#include "tools/fit_ltc/errors.h"
#include "tools/fit_ltc/fit.h"
#include "tools/fit_ltc/options.h"
#include "tools/fit_ltc/progress.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace antumbra::fit {

namespace {

constexpr uint32_t kReportDensity = 512; // places in a tenth of roughness

/// Nothing where it was interrupted: then nothing is written.
std::optional<bake::LtcTables> fitAndSave(const Options& options)
{
    const app::InterruptGuard interrupt;
    std::optional<bake::LtcTables> tables;
    {
        ProgressLine line;
        tables = fitTables({.size = options.size,
                            .threads = options.threads != 0 ? options.threads : std::max(std::thread::hardware_concurrency(), 1u),
                            .report = [&line](double share) { line.show(share); },
                            .isInterrupted = [&interrupt] { return interrupt.isInterrupted(); }});
    }
    if (tables)
        bake::saveLtcTables(options.folder, *tables);
    return tables;
}

/// Of another table of matrices; empty where none lies there.
Path amplitudeBeside(const Path& matrix)
{
    for (const char* name : {"ltc_2.exr", bake::kLtcAmplitudeFile})
        if (Path beside = matrix.parent_path() / name; std::filesystem::exists(beside))
            return beside;
    return {};
}

ErrorReport reported(const Path& path, const bake::LtcTables& tables)
{
    const ErrorReport report = errorsOf(tables, kReportDensity);
    fmt::print("{}: {} x {}\n{}", path.string(), tables.size, tables.size, describe(report));
    std::fflush(stdout);
    return report;
}

/// Whether all bounds hold of what is asked for.
bool isGood(const Options& options, const std::optional<bake::LtcTables>& otherTables)
{
    // Read again, so that it is the files that are told of.
    const ErrorReport ours = reported(options.folder / bake::kLtcMatrixFile, bake::loadLtcTables(options.folder));
    const std::string out = options.isCheck ? whereOutOfBounds(ours) : "";
    if (!out.empty())
        logError("out of bounds: {}", out);
    if (options.compare.empty())
        return out.empty();
    const bake::LtcTables other =
        otherTables ? *otherTables : bake::loadLtcTables(options.compare, options.folder / bake::kLtcAmplitudeFile);
    const std::string worse = whereWorse(ours, reported(options.compare, other));
    fmt::print("{}\n", worse.empty() ? "no mean is worse" : "worse: " + worse);
    return out.empty() && worse.empty();
}

ExitCode run(const Options& options)
{
    // What can be found wrong is found before minutes of fitting.
    std::optional<bake::LtcTables> other;
    if (!options.compare.empty()) {
        if (!std::filesystem::exists(options.compare))
            throw Error("no such file", options.compare.string());
        if (const Path amplitude = amplitudeBeside(options.compare); !amplitude.empty())
            other = bake::loadLtcTables(options.compare, amplitude);
    }
    if (std::filesystem::exists(options.folder) && !std::filesystem::is_directory(options.folder))
        throw Error("not a folder", options.folder.string());
    if (!options.isCheck && !fitAndSave(options)) {
        logWarning("interrupted: nothing is written");
        return ExitCode::CheckFailed;
    }
    return isGood(options, other) ? ExitCode::Done : ExitCode::CheckFailed;
}

} // namespace
} // namespace antumbra::fit

int main(int argc, char** argv)
{
    using namespace antumbra;
    try {
        const std::optional<fit::Options> options = fit::parse(argc, argv);
        return static_cast<int>(options ? fit::run(*options) : ExitCode::Done);
    } catch (const Error& error) {
        logError("{}", error.what());
        return static_cast<int>(error.code);
    }
}
