#include "tools/lab/results.h"

#include "base/error.h"
#include "scene/json_object.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <thread>

namespace antumbra::lab {

namespace {

using Json = nlohmann::ordered_json;

struct Figure
{
    const char* name;
    double app::ImageError::*value;
};

constexpr int kColumnWidth = 26;

constexpr Figure kFigures[] = {{"rmse", &app::ImageError::rmse},
                               {"relative_rmse", &app::ImageError::relativeRmse},
                               {"mae", &app::ImageError::mae},
                               {"ssim", &app::ImageError::ssim},
                               {"percentile_99", &app::ImageError::percentile99}};

Json jsonOf(const std::vector<Series>& all)
{
    Json object = Json::object();
    for (const Series& series : all) {
        Json& summary = object[series.name] = {{"lower", nullptr}, {"median", nullptr}, {"upper", nullptr}, {"values", series.values}};
        if (series.values.empty())
            continue;
        const app::Quartiles quartiles = app::quartilesOf(series.values);
        summary["lower"] = quartiles.lower;
        summary["median"] = quartiles.median;
        summary["upper"] = quartiles.upper;
    }
    return object;
}

Json jsonOf(const std::optional<app::ImageError>& error)
{
    if (!error)
        return nullptr;
    Json object = Json::object();
    for (const Figure& figure : kFigures)
        object[figure.name] = (*error).*figure.value; // NaN is written as null
    return object;
}

Json knobsOf(const Row& row)
{
    Json knobs = Json::object();
    for (const auto& [key, value] : row.knobs)
        knobs[key] = value;
    return knobs;
}

Json machineOf(const Results& results)
{
    Json machine = {{"threads", std::thread::hardware_concurrency()}, {"device", nullptr}};
    if (const std::optional<gpu::DeviceInfo>& device = results.device)
        machine.update({{"device", device->name},
                        {"driver", device->driver},
                        {"vulkan", device->api},
                        {"is_cpu", device->isCpu},
                        {"subgroup_size", device->subgroupSize}});
    return machine;
}

/// What a row must share with one that is taken over.
Json identityOf(const Row& row)
{
    const app::SweepPoint& point = row.point;
    return {{"name", point.name},
            {"scene", point.scene},
            {"size", {point.size.x, point.size.y}},
            {"time", point.seconds},
            {"animate", point.animates},
            {"turn", point.turnsLight},
            {"characters", point.hasCharacters},
            {"reference", point.referenceSamples},
            {"truth", point.truth == app::BakeTruth::Map ? "map" : "bands"},
            {"knobs", knobsOf(row)}};
}

Json jsonOf(const Row& row)
{
    Json object = identityOf(row);
    object["rounds"] = row.rounds;
    object["times_ms"] = jsonOf(row.samples.times);
    object["counters"] = jsonOf(row.samples.counters);
    object["error"] = jsonOf(row.error);
    return object;
}

std::vector<Series> seriesOf(const Json& object)
{
    std::vector<Series> all;
    for (const auto& [name, summary] : object.items())
        all.push_back({name, summary.at("values").get<std::vector<double>>()});
    return all;
}

void takeOver(Row& row, const Json& object)
{
    row.rounds = object.at("rounds").get<uint32_t>();
    row.samples = {seriesOf(object.at("times_ms")), seriesOf(object.at("counters"))};
    if (object.at("error").is_null())
        return;
    app::ImageError error;
    for (const Figure& figure : kFigures) {
        const Json& value = object.at("error").at(figure.name);
        error.*figure.value = value.is_null() ? std::nan("") : value.get<double>();
    }
    row.error = error;
}

std::vector<std::string> namesOf(const Results& results, std::vector<Series> Samples::*part)
{
    std::vector<std::string> names;
    for (const Row& row : results.rows)
        for (const Series& series : row.samples.*part)
            if (std::ranges::find(names, series.name) == names.end())
                names.push_back(series.name);
    return names;
}

std::string quoted(const std::string& text)
{
    std::string inside;
    for (const char c : text)
        inside += c == '"' ? "\"\"" : std::string(1, c);
    return '"' + inside + '"';
}

std::optional<app::Quartiles> quartilesOf(const std::vector<Series>& all, std::string_view name)
{
    const auto found = std::ranges::find(all, name, &Series::name);
    return found != all.end() && !found->values.empty() ? std::optional(app::quartilesOf(found->values)) : std::nullopt;
}

std::string headOf(const Results& results, const std::vector<std::string>& times, const std::vector<std::string>& counters)
{
    std::string line = "name,scene,width,height,time_s,rounds";
    for (const auto& [key, value] : results.rows.front().knobs)
        line += ',' + key;
    for (const Figure& figure : kFigures)
        line += fmt::format(",{}", figure.name);
    for (const std::string& name : times)
        for (const std::string_view quartile : {"lower", "median", "upper"})
            line += ',' + quoted(fmt::format("{} ms {}", name, quartile)); // names of passes may hold commas
    for (const std::string& name : counters)
        for (const std::string_view quartile : {"lower", "median", "upper"})
            line += ',' + quoted(fmt::format("{} {}", name, quartile));
    return line + '\n';
}

/// Empty where there is none.
std::string figureOf(const std::optional<app::ImageError>& error, const Figure& figure)
{
    return error && !std::isnan((*error).*figure.value) ? fmt::format("{:.6g}", (*error).*figure.value) : "";
}

std::string cellsOf(const std::vector<Series>& all, const std::vector<std::string>& names)
{
    std::string cells;
    for (const std::string& name : names) {
        const std::optional<app::Quartiles> quartiles = quartilesOf(all, name);
        cells += quartiles ? fmt::format(",{:.6g},{:.6g},{:.6g}", quartiles->lower, quartiles->median, quartiles->upper) : ",,,";
    }
    return cells;
}

} // namespace

std::string csvOf(const Results& results)
{
    const std::vector<std::string> times = namesOf(results, &Samples::times), counters = namesOf(results, &Samples::counters);
    std::string text = headOf(results, times, counters);
    for (const Row& row : results.rows) {
        const app::SweepPoint& point = row.point;
        text += fmt::format("{},{},{},{},{},{}", quoted(point.name), quoted(point.scene), point.size.x, point.size.y, point.seconds,
                            row.rounds);
        for (const auto& [key, value] : row.knobs)
            text += ',' + value;
        for (const Figure& figure : kFigures)
            text += "," + figureOf(row.error, figure);
        text += cellsOf(row.samples.times, times) + cellsOf(row.samples.counters, counters) + '\n';
    }
    return text;
}

std::string jsonOf(const Results& results)
{
    Json rows = Json::array();
    for (const Row& row : results.rows)
        rows.push_back(jsonOf(row));
    const Json document = {{"sweep", results.sweep}, {"machine", machineOf(results)}, {"rows", rows}};
    return document.dump(1) + '\n';
}

void resume(Results& results, const Path& file)
{
    try {
        const Json document = Json::parse(readText(file));
        if (document.at("machine") != machineOf(results))
            throw Error("measured on another device: it cannot be resumed here", file.string());
        for (const Json& object : document.at("rows")) {
            const auto row =
                std::ranges::find(results.rows, object.at("name").get<std::string>(), [](const Row& r) { return r.point.name; });
            const Json identity = row != results.rows.end() ? identityOf(*row) : Json::object({{"name", nullptr}});
            for (const auto& [key, value] : identity.items())
                if (object.at(key) != value)
                    throw Error(fmt::format("the row {} is of another sweep: {} differs", object.at("name").dump(), key), file.string());
            takeOver(*row, object);
        }
    } catch (const Json::exception& exception) {
        throw Error(fmt::format("not results of the lab: {}", exception.what()), file.string());
    }
}

std::string tableOf(const Results& results, std::span<const std::string_view> columns)
{
    std::vector<std::string_view> shown;
    const std::vector<std::string> measured = namesOf(results, &Samples::times);
    std::ranges::copy_if(columns, std::back_inserter(shown),
                         [&](std::string_view column) { return std::ranges::find(measured, column) != measured.end(); });
    std::string text = fmt::format("{:<52}", "medians, milliseconds");
    for (const std::string_view column : shown)
        text += fmt::format("{:>{}}", column, kColumnWidth);
    text += fmt::format("{:>12}{:>8}\n", "rel. RMSE", "SSIM");
    for (const Row& row : results.rows) {
        text += fmt::format("{:<52}", row.point.name);
        for (const std::string_view column : shown) {
            const std::optional<app::Quartiles> quartiles = quartilesOf(row.samples.times, column);
            text += quartiles ? fmt::format("{:{}.2f}", quartiles->median, kColumnWidth) : fmt::format("{:>{}}", "-", kColumnWidth);
        }
        const auto figure = [&](double app::ImageError::*value, int digits, std::string_view unit, double scale, int width) {
            const bool isKnown = row.error && !std::isnan((*row.error).*value);
            return fmt::format("{:>{}}", isKnown ? fmt::format("{:.{}f}{}", scale * (*row.error).*value, digits, unit) : "-", width);
        };
        text += figure(&app::ImageError::relativeRmse, 3, "%", 100, 12) + figure(&app::ImageError::ssim, 4, "", 1, 8) + '\n';
    }
    return text;
}

std::string fitOf(const Results& results, const app::SweepFit& fit)
{
    std::vector<std::vector<double>> quantities(fit.counters.size());
    std::vector<double> values;
    for (const Row& row : results.rows) {
        const std::optional<app::Quartiles> time = quartilesOf(row.samples.times, fit.time);
        std::vector<double> counted;
        for (const std::string& counter : fit.counters)
            if (const std::optional<app::Quartiles> count = quartilesOf(row.samples.counters, counter))
                counted.push_back(count->median);
        if (!time || counted.size() < quantities.size())
            continue;
        values.push_back(time->median);
        for (size_t i = 0; i < counted.size(); ++i)
            quantities[i].push_back(counted[i]);
    }
    const app::LinearFit found = app::fitLinear(quantities, values);
    std::string line = fmt::format("{}: {:.3g} ms", fit.time, found.weights[0]);
    for (size_t i = 0; i < fit.counters.size(); ++i)
        line +=
            fmt::format(" {} {:.3g} ns a {}", found.weights[i + 1] < 0 ? "-" : "+", 1e6 * std::abs(found.weights[i + 1]), fit.counters[i]);
    return line + fmt::format("; R^2 {:.4f} over {} rows\n", found.rSquared, values.size());
}

} // namespace antumbra::lab
