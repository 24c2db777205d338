#include "app/options.h"

#include "base/error.h"
#include "base/nearest.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>

namespace antumbra::app {

namespace {

constexpr uint32_t kLeastSize = 16;
constexpr uint32_t kGreatestSize = 8192;
constexpr uint32_t kGreatestFrames = 1000000;
constexpr double kGreatestSeconds = 1e6;

template <class Number>
std::optional<Number> parseNumber(std::string_view text)
{
    Number number{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return number;
}

[[noreturn]] void refuse(const std::string& option, std::string_view expected, std::string_view text)
{
    throw Error(fmt::format("takes {}, not \"{}\"", expected, text), option);
}

uvec2 parseSize(const std::string& option, const std::string& text)
{
    const size_t cross = std::min(text.find('x'), text.size());
    const auto width = parseNumber<uint32_t>(std::string_view(text).substr(0, cross));
    const auto height = parseNumber<uint32_t>(std::string_view(text).substr(std::min(cross + 1, text.size())));
    const auto fits = [](std::optional<uint32_t> edge) { return edge && *edge >= kLeastSize && *edge <= kGreatestSize; };
    if (!fits(width) || !fits(height))
        refuse(option, fmt::format("WIDTHxHEIGHT of {} to {} pixels each", kLeastSize, kGreatestSize), text);
    return {*width, *height};
}

uint32_t parseFrames(const std::string& option, const std::string& text)
{
    const auto frames = parseNumber<uint32_t>(text);
    if (!frames || *frames < 1 || *frames > kGreatestFrames)
        refuse(option, fmt::format("1 to {} frames", kGreatestFrames), text);
    return *frames;
}

double parseTime(const std::string& option, const std::string& text)
{
    const auto time = parseNumber<double>(text);
    // Written so that NaN is refused as well.
    if (!time || !(*time >= 0 && *time <= kGreatestSeconds))
        refuse(option, fmt::format("0 to {}", kGreatestSeconds), text);
    return *time;
}

EvalKind parseKind(const std::string& option, const std::string& text)
{
    if (text == "cones")
        return EvalKind::Cones;
    if (text == "irradiance")
        return EvalKind::Irradiance;
    if (text == "area")
        return EvalKind::Area;
    if (text == "sdf")
        return EvalKind::Sdf;
    refuse(option, "cones, irradiance, area or sdf", text);
}

std::pair<std::string, std::string> splitAtEquals(const std::string& option, std::string_view form, const std::string& text)
{
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        refuse(option, form, text);
    return {text.substr(0, equals), text.substr(equals + 1)};
}

Path parseFile(const std::string& option, const std::string& text, std::initializer_list<std::string_view> extensions)
{
    Path file = text;
    if (std::ranges::find(extensions, file.extension().string()) == extensions.end())
        refuse(option, fmt::format("a file that ends in {}", fmt::join(extensions, " or ")), text);
    return file;
}

// Adds an option (or a positional, where `name` has no dashes) whose text `read` turns into `target`.
template <class Target, class Read>
CLI::Option* add(CLI::App& command, const std::string& name, const std::string& form, Target& target, Read read, const std::string& doc)
{
    const auto take = [&target, name, read](const std::string& text) { target = read(name, text); };
    return command.add_option_function<std::string>(name, take, doc)->type_name(form);
}

std::string asText(const std::string&, const std::string& text) { return text; }

// Adds an option that may be repeated; `take` is called with each text.
template <class Take>
void addEach(CLI::App& command, const std::string& name, const std::string& form, Take take, const std::string& doc)
{
    const auto takeAll = [take](const std::vector<std::string>& texts) { std::ranges::for_each(texts, take); };
    // One value each time, or a scene that follows would be taken for another value.
    command.add_option_function<std::vector<std::string>>(name, takeAll, doc)->allow_extra_args(false)->type_name(form);
}

std::string describeKnobs()
{
    std::string text = "Knobs of --set:\n";
    for (const render::KnobDescription& knob : render::knobTable())
        text += fmt::format("  {:<22} {} ({})\n", knob.key, knob.doc, render::allowedValues(knob));
    return text;
}

void addSettings(CLI::App& command, render::Settings& settings)
{
    const auto take = [&settings](const std::string& text) {
        auto setting = splitAtEquals("--set", "KEY=VALUE", text);
        render::Knobs scratch;
        render::set(scratch, setting.first, setting.second);
        settings.push_back(std::move(setting));
    };
    addEach(command, "--set", "KEY=VALUE", take, "set a knob, over the scene file; may be repeated");
    command.footer(describeKnobs());
}

constexpr const char* kSceneDoc = "a name under assets/scenes, a scene file, or a .glb or .gltf";

void addPlay(CLI::App& command, PlayOptions& options)
{
    add(command, "scene", "SCENE", options.scene, asText, std::string(kSceneDoc) + "; plaza by default");
    add(command, "--size", "WxH", options.size, parseSize, "pixels of the window or the picture");
    command.add_flag("--headless", options.headless, "play without a window, as where there is no display");
    add(command, "--frames", "N", options.frames, parseFrames, "stop after N frames");
    add(command, "--script", "FILE", options.script, asText, "replay the input recorded in FILE");
    add(command, "--record", "FILE", options.record, asText, "record the input to FILE");
    add(command, "--screenshot", "FILE", options.screenshot, asText, "write the last frame to FILE");
    add(command, "--target-ms", "T", options.targetMilliseconds, parseTime,
        "as much quality of the occlusion pass as T milliseconds a frame allow");
    addSettings(command, options.settings);
}

void addRender(CLI::App& command, RenderOptions& options)
{
    const auto parsePicture = [](const auto& option, const auto& text) { return parseFile(option, text, {".exr", ".png"}); };
    const auto takeAov = [&options](const std::string& text) {
        const auto [name, file] = splitAtEquals("--aov", "NAME=FILE.exr", text);
        options.aovs.push_back({name, parseFile("--aov", file, {".exr"})});
    };
    add(command, "scene", "SCENE", options.scene, asText, kSceneDoc)->required();
    add(command, "--output", "FILE", options.output, parsePicture, "the picture, .exr (linear radiance) or .png (tone-mapped)")->required();
    add(command, "--size", "WxH", options.size, parseSize, "pixels of the picture; 640x360 by default");
    add(command, "--time", "SECONDS", options.seconds, parseTime, "the moment of the scene; 0 by default");
    add(command, "--frames", "N", options.frames, parseFrames, "render the moment N times, for the medians; the first picture is written");
    addEach(command, "--aov", "NAME=FILE.exr", takeAov, "write an intermediate picture as well; may be repeated");
    add(command, "--stats", "FILE", options.stats, asText, "write times, counters and memory as JSON");
    addSettings(command, options.settings);
}

void addEval(CLI::App& command, EvalOptions& options)
{
    add(command, "kind", "KIND", options.kind, parseKind, "cones, irradiance, area or sdf")->required();
    add(command, "cases", "CASES", options.cases, asText, "the cases, as JSON")->required();
    add(command, "--output", "FILE", options.output, asText, "the results, as JSON")->required();
    addSettings(command, options.settings);
}

void addInspect(CLI::App& command, InspectOptions& options)
{
    add(command, "file", "FILE", options.file, asText, "a .glb, .gltf, .hdr, .exr or .png")->required();
}

void addGraph(CLI::App& command, GraphOptions& options)
{
    const auto parsePlan = [](const auto& option, const auto& text) { return parseFile(option, text, {".dot", ".json"}); };
    add(command, "scene", "SCENE", options.scene, asText, kSceneDoc)->required();
    add(command, "--output", "FILE", options.output, parsePlan, "the plan, .dot or .json")->required();
    addSettings(command, options.settings);
}

// CLI11 would only repeat what was not expected, without what was perhaps meant.
[[noreturn]] void refuseUnexpected(const CLI::App& command)
{
    const std::string name = "antumbra " + command.get_name();
    const std::string word = command.remaining().front();
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_positional())
            names.push_back(option->get_name());
    if (!word.starts_with("-") || names.empty())
        throw Error(fmt::format("\"{}\" is one argument too many", word), name);
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw Error(fmt::format("no option {}; the nearest is {}", word, nearestWord(word, known)), name);
}

// What comes first is a command or a call for help, so that every later mistake is some command's.
void refuseUnknownCommand(const CLI::App& program, int argc, const char* const* argv)
{
    const std::string_view word = argc > 1 ? argv[1] : "";
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands({}))
        names.push_back(command->get_name());
    if (word == "-h" || word == "--help" || std::ranges::find(names, word) != names.end())
        return;
    if (word.empty() || word.starts_with("-"))
        throw Error(fmt::format("takes a command first: {}; see antumbra --help", fmt::join(names, ", ")), "antumbra");
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw Error(fmt::format("no command \"{}\"; the nearest is {}", word, nearestWord(word, known)), "antumbra");
}

} // namespace

Options parse(int argc, const char* const* argv)
{
    CLI::App program("Soft shadows by five published methods, each beside the truth.", "antumbra");
    program.require_subcommand(1);

    PlayOptions play;
    RenderOptions render;
    EvalOptions eval;
    InspectOptions inspect;
    GraphOptions graph;
    addPlay(*program.add_subcommand("play", "play a scene in a window, or headless where there is no display"), play);
    addRender(*program.add_subcommand("render", "render one moment of a scene to a file"), render);
    addEval(*program.add_subcommand("eval", "run cases through the renderer's shader functions on the device"), eval);
    program.add_subcommand("info", "show the device, its driver and features, and what is chosen for each effect");
    addInspect(*program.add_subcommand("inspect", "load a glTF file or an image and print what is in it"), inspect);
    addGraph(*program.add_subcommand("graph", "write the plan of a frame: passes, resources, and what is culled and why"), graph);
    program.footer("Each command has its own --help. Exit codes: 0 done, 1 a check failed, 2 bad input or usage, 3 no usable device.");
    refuseUnknownCommand(program, argc, argv);

    try {
        program.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return Help{program.help()};
    } catch (const CLI::ExtrasError&) {
        refuseUnexpected(*program.get_subcommands().front());
    } catch (const CLI::ParseError& error) {
        throw Error(error.what(), "antumbra " + program.get_subcommands().front()->get_name());
    }

    const std::string command = program.get_subcommands().front()->get_name();
    if (command == "play")
        return play;
    if (command == "render")
        return render;
    if (command == "eval")
        return eval;
    if (command == "inspect")
        return inspect;
    if (command == "graph")
        return graph;
    return InfoOptions{};
}

} // namespace antumbra::app
