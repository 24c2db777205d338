#include "tools/fit_ltc/options.h"

#include "base/error.h"
#include "tools/command_line.h"

namespace antumbra::fit {

std::optional<Options> parse(int argc, char** argv)
{
    Options options{.folder = projectPath("assets") / "fits"};
    CLI::App arguments("Fits linearly transformed cosines to the GGX reflection, and tells how far they are from it.", "fit_ltc");
    arguments.add_option("--output", options.folder, "the folder of both tables; assets/fits by default");
    arguments.add_option("--compare", options.compare,
                         "another table of matrices; its amplitudes are in ltc_2.exr or ltc_amplitude.exr beside it, or else ours");
    const CLI::Option* size = arguments.add_option("--size", options.size, "texels a side; 64 by default")->check(CLI::Range(2, 1024));
    arguments.add_option("--threads", options.threads, "as many as the machine has by default")->check(CLI::Range(1, 1024));
    arguments.add_flag("--check", options.isCheck, "fit nothing: report the tables that are there");
    arguments.footer("Ctrl-C ends it, and leaves what was there as it was.\n"
                     "Exit codes: 0 done, 1 interrupted, out of bounds or worse than what it is compared with, 2 bad input or usage.");
    if (!tools::parse(arguments, argc, argv))
        return std::nullopt;
    if (options.isCheck && size->count() > 0)
        throw Error("the size is the tables' own where nothing is fitted", "--size");
    return options;
}

} // namespace antumbra::fit
