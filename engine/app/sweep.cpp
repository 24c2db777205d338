#include "app/sweep.h"

#include "base/error.h"
#include "scene/json_object.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace antumbra::app {

namespace {

using nlohmann::json;
using scene::JsonObject;

constexpr std::string_view kOwnKnobs[] = {"view", "reference.samples"}; // of the lab: it draws the truth itself
constexpr std::string_view kBakeKnobs = "prt.";
constexpr scene::Words<Measure, 2> kMeasures{{{"frames", Measure::Frames}, {"bakes", Measure::Bakes}}};
constexpr scene::Words<BakeTruth, 2> kTruths{{{"bands", BakeTruth::Bands}, {"map", BakeTruth::Map}}};
constexpr size_t kMostPoints = 10'000;

/// A knob and the values it takes.
struct Axis
{
    std::string key;
    std::vector<std::string> values;
};
using Grid = std::vector<Axis>;

void checkSetting(const JsonObject& object, std::string_view place, const std::string& key, const std::string& value)
{
    if (std::ranges::find(kOwnKnobs, key) != std::end(kOwnKnobs))
        object.refuse(place, fmt::format("{} is the lab's own to set", key));
    try {
        render::Knobs knobs;
        render::set(knobs, key, value);
    } catch (const Error& error) {
        object.refuse(place, error.what());
    }
}

std::string textOf(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

Grid readGrid(const json& grid, const JsonObject& holder)
{
    if (!grid.is_object())
        holder.refuse("grid", "expected an object");
    Grid axes;
    for (const auto& [key, values] : grid.items()) {
        if (!values.is_array() || values.empty())
            holder.refuse("grid", fmt::format("{} takes an array of values", key));
        Axis& axis = axes.emplace_back(Axis{.key = key, .values = {}});
        for (const json& value : values) {
            axis.values.push_back(textOf(value));
            checkSetting(holder, "grid", key, axis.values.back());
        }
    }
    return axes;
}

/// "samples" of "occlusion.samples".
std::string_view lastWord(std::string_view key) { return key.substr(key.rfind('.') + 1); }

/// One point for every combination of values.
std::vector<SweepPoint> expand(const SweepPoint& point, const Grid& grid, const JsonObject& object)
{
    std::vector<SweepPoint> points{point};
    for (const Axis& axis : grid) {
        std::vector<SweepPoint> more;
        for (const SweepPoint& base : points)
            for (const std::string& value : axis.values) {
                SweepPoint& made = more.emplace_back(base);
                made.name += fmt::format(" {}={}", lastWord(axis.key), value);
                made.settings.emplace_back(axis.key, value);
            }
        points = std::move(more);
        if (points.size() > kMostPoints)
            object.refuse("grid", fmt::format("more than {} points", kMostPoints));
    }
    return points;
}

void readFrames(const JsonObject& object, SweepPoint& point)
{
    object.allowOnly({"name", "scene", "reference", "settings", "grid"}, {"size", "time", "frames", "animate", "turn", "characters"});
    point.size = uvec2(object.vector("size", vec2(point.size), {16, 8192}));
    point.seconds = object.number("time", point.seconds, {0, 1e6f});
    point.frames = static_cast<uint32_t>(object.integer("frames", static_cast<int32_t>(point.frames), {1, 10'000}));
    point.animates = object.flag("animate", point.animates);
    point.turnsLight = object.flag("turn", point.turnsLight);
    point.hasCharacters = object.flag("characters", point.hasCharacters);
}

void readBake(const JsonObject& object, SweepPoint& point)
{
    object.allowOnly({"name", "scene", "reference", "settings", "grid"}, {"truth"});
    point.truth = object.choice("truth", std::optional(point.truth), kTruths);
}

SweepFit readFit(const JsonObject& object)
{
    object.allowOnly({"time", "counters"});
    SweepFit fit{.time = object.text("time", ""), .counters = object.texts("counters")};
    if (fit.time.empty() || fit.counters.empty())
        object.refuse("", "needs \"time\" and \"counters\"");
    return fit;
}

SweepPoint readPoint(const JsonObject& object, Measure measure)
{
    SweepPoint point;
    if (measure == Measure::Bakes)
        readBake(object, point);
    else
        readFrames(object, point);
    point.scene = object.text("scene", "");
    if (point.scene.empty())
        object.refuse("", "needs \"scene\"");
    point.name = object.text("name", point.scene);
    point.referenceSamples = static_cast<uint32_t>(object.integer("reference", 0, {0, 1'000'000}));
    point.settings = object.object("settings").pairs();
    for (const auto& [key, value] : point.settings)
        checkSetting(object, "settings", key, value);
    return point;
}

void checkBakeKnobs(const Sweep& sweep, const JsonObject& object)
{
    for (const SweepPoint& point : sweep.points)
        for (const auto& [key, value] : point.settings)
            if (!key.starts_with(kBakeKnobs))
                object.refuse("points", fmt::format("{} does not concern bakes", key));
}

void checkNames(const Sweep& sweep, const JsonObject& object)
{
    std::set<std::string_view> names;
    for (const SweepPoint& point : sweep.points)
        if (!names.insert(point.name).second)
            object.refuse("points", fmt::format("two are named \"{}\"", point.name));
}

} // namespace

Sweep loadSweep(const Path& file)
{
    const json document = scene::parseJson(file);
    const JsonObject object(document, file, "");
    object.allowOnly({"name", "measure", "repeats", "warmup", "fit", "grid", "points"});
    Sweep sweep;
    sweep.name = object.text("name", file.stem().string());
    sweep.measure = object.choice("measure", std::optional(sweep.measure), kMeasures);
    sweep.repeats = static_cast<uint32_t>(object.integer("repeats", static_cast<int32_t>(sweep.repeats), {1, 1000}));
    sweep.warmUp = static_cast<uint32_t>(object.integer("warmup", static_cast<int32_t>(sweep.warmUp), {1, 1000}));
    if (object.has("fit"))
        sweep.fit = readFit(object.object("fit"));
    const Grid common = object.has("grid") ? readGrid(document["grid"], object) : Grid{};
    const std::vector<JsonObject> points = object.objects("points");
    for (size_t i = 0; i < points.size(); ++i) {
        const Grid grid = points[i].has("grid") ? readGrid(document["points"][i]["grid"], points[i]) : common;
        std::ranges::move(expand(readPoint(points[i], sweep.measure), grid, points[i]), std::back_inserter(sweep.points));
    }
    if (sweep.points.empty())
        object.refuse("points", "there is nothing to measure");
    checkNames(sweep, object);
    if (sweep.measure == Measure::Bakes)
        checkBakeKnobs(sweep, object);
    return sweep;
}

void checkKept(const Path& file, const Sweep& sweep, const Path& folder)
{
    std::error_code isMissing; // then nothing is there to be lost
    if (std::filesystem::equivalent(file, folder / (sweep.name + ".json"), isMissing))
        throw Error("results would overwrite it; they need another folder, or the sweep another name", file.string());
}

} // namespace antumbra::app
