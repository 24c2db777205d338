#include "tools/bake/options.h"

#include "bake/bake_file.h"
#include "bake/settings.h"
#include "base/error.h"
#include "tools/command_line.h"

#include <algorithm>

namespace antumbra::baking {

namespace {

constexpr std::string_view kPrefix = "prt.";

std::pair<std::string, std::string> splitAtEquals(const std::string& text)
{
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw Error(fmt::format("takes KEY=VALUE, not \"{}\"", text), "--set");
    const std::string key = text.substr(0, equals);
    if (!key.starts_with(kPrefix))
        throw Error(fmt::format("knobs of a bake begin with \"{}\"", kPrefix), key);
    return {key, text.substr(equals + 1)};
}

std::string describeKnobs()
{
    std::string text = "Knobs of --set:\n";
    for (const bake::BakeSetting& setting : bake::kBakeSettings)
        text += fmt::format("  {:<14} {} ({:.6g} to {:.6g}; {:.6g})\n", setting.key, setting.doc, setting.least, setting.greatest,
                            setting.read({}));
    return text;
}

} // namespace

std::optional<Options> parse(int argc, char** argv)
{
    Options options;
    uint64_t mebibytes = 0;
    std::vector<std::string> settings;
    CLI::App arguments("Bakes the light of a scene: of all that is StaticPRT, and of the space between.", "bake");
    arguments.add_option("SCENE", options.scene, "a name under assets/scenes, or a scene file")->required();
    arguments.add_option("--output", options.output, "the bake; assets/bakes/NAME.exr, or beside the scene, by default");
    arguments.add_option("--set", settings, "set a knob, over the scene file; may be repeated")->allow_extra_args(false);
    arguments.add_option("--threads", options.threads, "of each process; as many as the machine has by default")
        ->check(CLI::Range(1, 1024));
    arguments.add_option("--memory-limit", mebibytes, "refuse a bake that takes more MiB")->check(CLI::Range(1, 1 << 24));
    arguments.add_flag("--resume", options.isResumed, "go on from what an interrupted bake has kept");
    arguments.footer(describeKnobs() + "Ctrl-C keeps what is done. mpirun -n N bake ... bakes in N processes.\n"
                                       "Exit codes: 0 done, 1 interrupted, 2 bad input or usage.");
    if (!tools::parse(arguments, argc, argv))
        return std::nullopt;
    std::ranges::transform(settings, std::back_inserter(options.settings), splitAtEquals);
    if (mebibytes != 0)
        options.mostBytes = mebibytes << 20;
    if (options.output.empty())
        options.output = bake::bakePathOf(options.scene);
    return options;
}

} // namespace antumbra::baking
