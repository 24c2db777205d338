#include "scene/json_object.h"

#include "base/error.h"
#include "base/nearest.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace antumbra::scene {

namespace {

using nlohmann::json;

constexpr uint64_t kGreatestBytes = uint64_t{1} << 24;

const json& emptyObject()
{
    static const json empty = json::object();
    return empty;
}

} // namespace

json parseJson(const Path& file)
{
    const std::string text = readText(file, kGreatestBytes);
    try {
        return json::parse(text);
    } catch (const json::exception& exception) {
        // The library's own tag, as in "[json.exception.parse_error.101] ", says nothing to whoever wrote the file.
        const std::string_view reason = exception.what();
        const size_t tagEnd = reason.find("] ");
        throw Error(std::string(reason.substr(tagEnd == std::string_view::npos ? 0 : tagEnd + 2)), file.string());
    }
}

JsonObject::JsonObject(const json& value, const Path& file, std::string where) : value_(&value), file_(file), where_(std::move(where))
{
    if (!value.is_object())
        refuse("", fmt::format("expected an object, found {}", value.type_name()));
}

void JsonObject::allowOnly(std::initializer_list<std::string_view> keys, std::initializer_list<std::string_view> moreKeys) const
{
    std::vector<std::string_view> known(keys);
    known.insert(known.end(), moreKeys);
    for (const auto& [key, value] : value_->items()) {
        if (known.empty())
            refuse("", fmt::format("unknown key \"{}\", there are none", key));
        if (std::ranges::find(known, key) == known.end())
            refuse("", fmt::format("unknown key \"{}\", the nearest is \"{}\"", key, nearestWord(key, known)));
    }
}

bool JsonObject::has(std::string_view key) const { return find(key) != nullptr; }

bool JsonObject::isNumber(std::string_view key) const
{
    const json* value = find(key);
    return value != nullptr && value->is_number();
}

const json* JsonObject::find(std::string_view key) const
{
    const auto found = value_->find(key);
    return found != value_->end() ? &*found : nullptr;
}

std::string JsonObject::placeOf(std::string_view key) const
{
    if (key.empty() || where_.empty())
        return where_ + std::string(key);
    return fmt::format("{}.{}", where_, key);
}

void JsonObject::refuse(std::string_view key, const std::string& reason) const
{
    const std::string place = placeOf(key);
    throw Error(place.empty() ? reason : place + ": " + reason, file_.string());
}

float JsonObject::checkedNumber(const json& value, std::string_view key, Range<float> range) const
{
    if (!value.is_number())
        refuse(key, fmt::format("expected a number, found {}", value.type_name()));
    const double number = value.get<double>();
    if (!(number >= double{range.least} && number <= double{range.greatest}))
        refuse(key, fmt::format("{} is not between {} and {}", number, range.least, range.greatest));
    return static_cast<float>(number);
}

float JsonObject::number(std::string_view key, float fallback, Range<float> range) const
{
    const json* value = find(key);
    return value != nullptr ? checkedNumber(*value, key, range) : fallback;
}

int32_t JsonObject::integer(std::string_view key, int32_t fallback, Range<int32_t> range) const
{
    const json* value = find(key);
    if (value == nullptr)
        return fallback;
    const bool isInteger = value->is_number_integer();
    if (!isInteger || value->get<double>() < range.least || value->get<double>() > range.greatest)
        refuse(key, fmt::format("expected an integer from {} to {}", range.least, range.greatest));
    return value->get<int32_t>();
}

bool JsonObject::flag(std::string_view key, bool fallback) const
{
    const json* value = find(key);
    if (value != nullptr && !value->is_boolean())
        refuse(key, "expected true or false");
    return value != nullptr ? value->get<bool>() : fallback;
}

std::string JsonObject::text(std::string_view key, std::string fallback) const
{
    const json* value = find(key);
    if (value != nullptr && !value->is_string())
        refuse(key, fmt::format("expected a string, found {}", value->type_name()));
    return value != nullptr ? value->get<std::string>() : std::move(fallback);
}

void JsonObject::readNumbers(const json& array, std::string_view key, std::span<float> numbers, Range<float> range) const
{
    if (!array.is_array() || array.size() != numbers.size())
        refuse(key, fmt::format("expected {} numbers in an array", numbers.size()));
    for (size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = checkedNumber(array[i], key, range);
}

void JsonObject::readNumbers(std::string_view key, std::span<float> numbers, Range<float> range) const
{
    if (const json* value = find(key))
        readNumbers(*value, key, numbers, range);
}

vec2 JsonObject::vector(std::string_view key, vec2 fallback, Range<float> range) const
{
    readNumbers(key, {&fallback.x, 2}, range);
    return fallback;
}

vec3 JsonObject::vector(std::string_view key, vec3 fallback, Range<float> range) const
{
    readNumbers(key, {&fallback.x, 3}, range);
    return fallback;
}

vec4 JsonObject::vector(std::string_view key, vec4 fallback, Range<float> range) const
{
    readNumbers(key, {&fallback.x, 4}, range);
    return fallback;
}

vec3 JsonObject::direction(std::string_view key, vec3 fallback) const
{
    const vec3 along = vector(key, fallback, kAnyLength);
    if (glm::length(along) < 1e-6f)
        refuse(key, "a direction has a length");
    return glm::normalize(along);
}

size_t JsonObject::indexOfWord(std::string_view key, std::span<const std::string_view> words) const
{
    if (!has(key))
        refuse("", fmt::format("needs \"{}\": one of {}", key, fmt::join(words, ", ")));
    const std::string word = text(key, "");
    const auto found = std::ranges::find(words, word);
    if (found == words.end())
        refuse(key, fmt::format("unknown \"{}\", the nearest is \"{}\"", word, nearestWord(word, words)));
    return static_cast<size_t>(found - words.begin());
}

JsonObject JsonObject::object(std::string_view key) const
{
    const json* value = find(key);
    return {value != nullptr ? *value : emptyObject(), file_, placeOf(key)};
}

std::vector<JsonObject> JsonObject::objects(std::string_view key) const
{
    const json* array = find(key);
    if (array != nullptr && !array->is_array())
        refuse(key, fmt::format("expected an array, found {}", array->type_name()));
    std::vector<JsonObject> objects;
    for (size_t i = 0; array != nullptr && i < array->size(); ++i)
        objects.emplace_back((*array)[i], file_, fmt::format("{}[{}]", placeOf(key), i));
    return objects;
}

std::vector<vec2> JsonObject::points(std::string_view key, Range<float> range) const
{
    const json* array = find(key);
    if (array == nullptr || !array->is_array())
        refuse(key, "expected an array of points");
    std::vector<vec2> points(array->size());
    for (size_t i = 0; i < points.size(); ++i)
        readNumbers((*array)[i], key, {&points[i].x, 2}, range);
    return points;
}

std::vector<std::string> JsonObject::texts(std::string_view key) const
{
    const json* array = find(key);
    if (array == nullptr)
        return {};
    const bool isTexts = array->is_array() && std::ranges::all_of(*array, [](const json& value) { return value.is_string(); });
    if (!isTexts)
        refuse(key, "expected an array of strings");
    return array->get<std::vector<std::string>>();
}

std::vector<std::pair<std::string, std::string>> JsonObject::pairs() const
{
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const auto& [key, value] : value_->items()) {
        if (!value.is_number() && !value.is_string() && !value.is_boolean())
            refuse(key, "expected a number, a string, true or false");
        pairs.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return pairs;
}

} // namespace antumbra::scene
