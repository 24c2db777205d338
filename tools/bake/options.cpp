#include "tools/bake/options.h"

#include "bake/bake_file.h"
#include "bake/settings.h"
#include "base/error.h"
#include "base/nearest.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace antumbra::baking {

namespace {

constexpr std::string_view kPrefix = "prt.";

void set(bake::BakeSettings& settings, const std::string& key, const std::string& value)
{
    const auto known = bake::bakeSettings();
    const auto found = std::ranges::find(known, std::string_view(key).substr(kPrefix.size()), &bake::BakeSetting::name);
    if (found == known.end()) {
        std::vector<std::string_view> names;
        std::ranges::transform(known, std::back_inserter(names), &bake::BakeSetting::name);
        throw Error(
            fmt::format("no such knob; the nearest is {}{}", kPrefix, nearestWord(std::string_view(key).substr(kPrefix.size()), names)),
            key);
    }
    double number = 0;
    const auto [end, failure] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (failure != std::errc{} || end != value.data() + value.size() || !found->allows(number))
        throw Error(fmt::format("takes {:.6g} to {:.6g}{}, not \"{}\"", found->least, found->greatest,
                                found->isWhole ? ", a whole number" : "", value),
                    key);
    found->write(settings, number);
}

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
    for (const bake::BakeSetting& setting : bake::bakeSettings())
        text += fmt::format("  {}{:<10} {} ({:.6g} to {:.6g}; {:.6g})\n", kPrefix, setting.name, setting.doc, setting.least,
                            setting.greatest, setting.read({}));
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
    try {
        arguments.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", arguments.help());
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw Error(error.what(), "bake");
    }
    std::ranges::transform(settings, std::back_inserter(options.settings), splitAtEquals);
    if (mebibytes != 0)
        options.mostBytes = mebibytes << 20;
    if (options.output.empty())
        options.output = bake::bakePathOf(options.scene);
    return options;
}

bake::BakeSettings settingsOf(const scene::Settings& sceneFile, const scene::Settings& commandLine)
{
    bake::BakeSettings result;
    for (const scene::Settings* settings : {&sceneFile, &commandLine})
        for (const auto& [key, value] : *settings)
            if (key.starts_with(kPrefix))
                set(result, key, value);
    return result;
}

} // namespace antumbra::baking
