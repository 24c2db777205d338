#include "app/script.h"

#include "base/error.h"
#include "base/nearest.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace antumbra::app {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr std::array<std::string_view, kActionCount> kActionNames{"wave",   "change camera",  "pause",       "single step", "slower",
                                                                  "faster", "toggle overlay", "toggle keys", "next view",   "screenshot",
                                                                  "quit"};
constexpr std::string_view kHeaderKeys[] = {"script", "seed", "frames"};
constexpr std::string_view kStepKeys[] = {"frame", "move", "run", "rotate_environment", "look", "zoom", "press", "set", "split"};
constexpr double kGreatestLook = 100;
constexpr double kGreatestZoom = 1000;
constexpr float kRounding = 1e-5f; // of a length that was made 1

/// One line of a script, read strictly; what is wrong with it is thrown with its place.
class Line
{
public:
    Line(std::string_view text, std::string place) : place_(std::move(place))
    {
        try {
            value_ = json::parse(text);
        } catch (const json::parse_error& error) {
            refuse(fmt::format("not JSON near column {}", error.byte));
        }
        if (!value_.is_object())
            refuse("not a JSON object");
    }

    [[noreturn]] void refuse(const std::string& reason) const { throw Error(reason, place_); }

    void allowOnly(std::span<const std::string_view> keys) const
    {
        for (const auto& [key, value] : value_.items())
            if (std::ranges::find(keys, key) == keys.end())
                refuse(fmt::format("unknown key \"{}\"; the nearest is \"{}\"", key, nearestWord(key, keys)));
    }
    [[nodiscard]] bool has(const char* key) const { return value_.contains(key); }
    [[nodiscard]] uint64_t whole(const char* key, uint64_t greatest) const
    {
        const json value = value_.value(key, json());
        if (!value.is_number_unsigned() || value.get<uint64_t>() > greatest)
            refuse(fmt::format("\"{}\" takes a whole number up to {}", key, greatest));
        return value.get<uint64_t>();
    }
    [[nodiscard]] float number(const char* key, double greatest) const { return checked(key, value_.at(key), greatest); }
    [[nodiscard]] vec2 pair(const char* key, double greatest) const
    {
        const json& value = value_.at(key);
        if (!value.is_array() || value.size() != 2)
            refuse(fmt::format("\"{}\" takes two numbers", key));
        return {checked(key, value[0], greatest), checked(key, value[1], greatest)};
    }
    [[nodiscard]] bool flag(const char* key) const
    {
        if (!value_.at(key).is_boolean())
            refuse(fmt::format("\"{}\" takes true or false", key));
        return value_.at(key).get<bool>();
    }
    /// One word or a list of them.
    [[nodiscard]] std::vector<std::string> words(const char* key) const
    {
        const json& value = value_.at(key);
        const json list = value.is_array() ? value : json::array({value});
        if (!std::ranges::all_of(list, [](const json& word) { return word.is_string(); }))
            refuse(fmt::format("\"{}\" takes text or a list of texts", key));
        return list.get<std::vector<std::string>>();
    }

private:
    [[nodiscard]] float checked(const char* key, const json& value, double greatest) const
    {
        // Written so that NaN is refused as well.
        if (!value.is_number() || !(std::abs(value.get<double>()) <= greatest))
            refuse(fmt::format("\"{0}\" takes -{1} to {1}", key, greatest));
        return value.get<float>();
    }

    std::string place_;
    json value_;
};

Action readAction(const Line& line, const std::string& word)
{
    const auto* found = std::ranges::find(kActionNames, word);
    if (found == kActionNames.end())
        line.refuse(fmt::format("no action \"{}\"; the nearest is \"{}\"", word, nearestWord(word, kActionNames)));
    return static_cast<Action>(found - kActionNames.begin());
}

std::pair<std::string, std::string> readSetting(const Line& line, const std::string& text)
{
    const size_t equals = text.find('=');
    if (equals == std::string::npos)
        line.refuse(fmt::format("\"set\" takes KEY=VALUE, not \"{}\"", text));
    std::pair<std::string, std::string> setting{text.substr(0, equals), text.substr(equals + 1)};
    render::Knobs scratch;
    try {
        render::set(scratch, setting.first, setting.second);
    } catch (const Error& error) {
        line.refuse(error.what());
    }
    return setting;
}

void readStep(const Line& line, ScriptStep& step)
{
    InputFrame& input = step.input;
    if (line.has("move"))
        input.move = line.pair("move", 1);
    if (glm::length(input.move) > 1 + kRounding)
        line.refuse("\"move\" is at most 1 long");
    if (line.has("run"))
        input.isRunning = line.flag("run");
    if (line.has("rotate_environment"))
        input.turnLight = line.number("rotate_environment", 1);
    if (line.has("look"))
        input.look = line.pair("look", kGreatestLook);
    if (line.has("zoom"))
        input.zoom = line.number("zoom", kGreatestZoom);
    if (line.has("press"))
        for (const std::string& word : line.words("press"))
            input.ask(readAction(line, word));
    if (line.has("set"))
        for (const std::string& text : line.words("set"))
            step.settings.push_back(readSetting(line, text));
    if (line.has("split"))
        step.splitColumn = static_cast<uint32_t>(line.whole("split", 8192));
}

/// What the step after one that read `input` starts from.
InputFrame heldOf(const InputFrame& input) { return {.move = input.move, .turnLight = input.turnLight, .isRunning = input.isRunning}; }

/// Written with as many digits as a float needs, not a double.
double shortest(float value) { return std::strtod(fmt::format("{}", value).c_str(), nullptr); }

void appendHeld(ordered_json& line, const InputFrame& input, const InputFrame& before)
{
    if (input.move != before.move)
        line["move"] = {shortest(input.move.x), shortest(input.move.y)};
    if (input.isRunning != before.isRunning)
        line["run"] = input.isRunning;
    if (input.turnLight != before.turnLight)
        line["rotate_environment"] = shortest(input.turnLight);
}

void appendOnce(ordered_json& line, const ScriptStep& step)
{
    if (step.input.look != vec2(0))
        line["look"] = {shortest(step.input.look.x), shortest(step.input.look.y)};
    if (step.input.zoom != 0)
        line["zoom"] = shortest(step.input.zoom);
    for (uint32_t action = 0; action < kActionCount; ++action)
        if (step.input.asks(static_cast<Action>(action)))
            line["press"].push_back(kActionNames[action]);
    for (const auto& [key, value] : step.settings)
        line["set"].push_back(fmt::format("{}={}", key, value));
    if (step.splitColumn)
        line["split"] = *step.splitColumn;
}

} // namespace

std::string_view nameOf(Action action) { return kActionNames[static_cast<size_t>(action)]; }

Script parseScript(std::string_view text, const std::string& file)
{
    Script script;
    bool isOpened = false;
    size_t current = 0; // the step that the last line was about
    const auto goTo = [&](size_t frame) {
        for (; current < frame; ++current)
            script.steps[current + 1].input = heldOf(script.steps[current].input);
    };
    for (size_t number = 1; !text.empty(); ++number) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view content = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (content.find_first_not_of(" \t\r") == std::string_view::npos)
            continue;
        const Line line(content, fmt::format("{}:{}", file, number));
        line.allowOnly(isOpened ? std::span<const std::string_view>(kStepKeys) : kHeaderKeys);
        if (!isOpened) {
            if (line.whole("script", 1000) != kFormat)
                line.refuse(fmt::format("a script of another format than {}", kFormat));
            script.seed = line.whole("seed", ~uint64_t{0});
            script.steps.resize(line.whole("frames", kGreatestScriptFrames));
            isOpened = true;
            continue;
        }
        const size_t frame = line.whole("frame", std::max<size_t>(script.steps.size(), 1) - 1);
        if (frame < current)
            line.refuse(fmt::format("frame {} comes after frame {}", frame, current));
        if (script.steps.empty())
            line.refuse("a script of no frames");
        goTo(frame);
        readStep(line, script.steps[frame]);
    }
    if (!isOpened)
        throw Error("an empty script", file);
    if (!script.steps.empty())
        goTo(script.steps.size() - 1);
    return script;
}

Script loadScript(const Path& file) { return parseScript(readText(file), file.string()); }

std::string scriptText(const Script& script)
{
    std::string text = fmt::format("{{\"script\": {}, \"seed\": {}, \"frames\": {}}}\n", kFormat, script.seed, script.steps.size());
    InputFrame before;
    for (size_t frame = 0; frame < script.steps.size(); ++frame) {
        ordered_json line;
        line["frame"] = frame;
        appendHeld(line, script.steps[frame].input, before);
        appendOnce(line, script.steps[frame]);
        before = script.steps[frame].input;
        if (line.size() > 1)
            text += line.dump() + "\n";
    }
    return text;
}

} // namespace antumbra::app
