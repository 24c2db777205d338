// lab SWEEP.json --output DIR [--resume]: the command line of the lab (DESIGN.md, Commands).
#include "base/error.h"
#include "base/log.h"
#include "tools/command_line.h"
#include "tools/lab/bake_lab.h"
#include "tools/lab/lab.h"

#include <optional>

namespace {

using namespace antumbra;

struct Options
{
    Path sweep;
    Path output;
    bool resumes = false;
};

/// Nothing where help was asked for and given.
std::optional<Options> parse(int argc, char** argv)
{
    Options options;
    CLI::App arguments("Measures the points of a sweep: times, counters, and the error against the reference.", "lab");
    arguments.add_option("SWEEP", options.sweep, "file that lists the points, as in tools/sweeps")->required();
    arguments.add_option("--output", options.output, "folder for the results, NAME.json and NAME.csv")->required();
    arguments.add_flag("--resume", options.resumes, "go on from the results that are there");
    if (!tools::parse(arguments, argc, argv))
        return std::nullopt;
    return options;
}

/// False where somebody interrupted it.
bool run(const Options& options)
{
    app::Sweep sweep = app::loadSweep(options.sweep);
    app::checkKept(options.sweep, sweep, options.output);
    if (sweep.measure == app::Measure::Bakes)
        return lab::BakeLab(std::move(sweep), options.output, options.resumes).run();
    return lab::Lab(std::move(sweep), options.output, options.resumes).run();
}

} // namespace

int main(int argc, char** argv)
{
    try {
        const std::optional<Options> options = parse(argc, argv);
        if (!options)
            return static_cast<int>(ExitCode::Done);
        return static_cast<int>(run(*options) ? ExitCode::Done : ExitCode::CheckFailed);
    } catch (const Error& error) {
        logError("{}", error.what());
        return static_cast<int>(error.code);
    }
}
