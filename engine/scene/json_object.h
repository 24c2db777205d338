// One object of a JSON file, read strictly: every value has a type and a range, unknown keys are refused by name, and an error says
// where in which file. Writes nothing; keeps no copy, so the document must outlive it.
#pragma once

#include "base/file.h"
#include "base/math.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <utility>

namespace antumbra::scene {

/// Throws Error with line and column for what is not JSON.
nlohmann::json parseJson(const Path& file);

/// Both ends are allowed.
template <class Number>
struct Range
{
    Number least;
    Number greatest;
};
inline constexpr Range<float> kAnyLength{-1e6f, 1e6f};
inline constexpr Range<float> kPositiveLength{1e-6f, 1e6f};
inline constexpr Range<float> kAnyDegrees{-36000, 36000};

template <class Value, size_t kCount>
using Words = std::array<std::pair<std::string_view, Value>, kCount>;

/// Readers return `fallback` where the key is absent, and throw Error for a value of the wrong type or out of range.
class JsonObject
{
public:
    JsonObject(const nlohmann::json& value, const Path& file, std::string where);

    /// Throws Error for any other key, with the nearest of these.
    void allowOnly(std::initializer_list<std::string_view> keys, std::initializer_list<std::string_view> moreKeys = {}) const;
    [[nodiscard]] bool has(std::string_view key) const;
    [[nodiscard]] bool isNumber(std::string_view key) const;

    [[nodiscard]] float number(std::string_view key, float fallback, Range<float> range) const;
    [[nodiscard]] int32_t integer(std::string_view key, int32_t fallback, Range<int32_t> range) const;
    [[nodiscard]] bool flag(std::string_view key, bool fallback) const;
    [[nodiscard]] std::string text(std::string_view key, std::string fallback) const;
    [[nodiscard]] vec2 vector(std::string_view key, vec2 fallback, Range<float> range) const;
    [[nodiscard]] vec3 vector(std::string_view key, vec3 fallback, Range<float> range) const;
    [[nodiscard]] vec4 vector(std::string_view key, vec4 fallback, Range<float> range) const;
    /// A number stands for a vector of it.
    template <class Vector>
    [[nodiscard]] Vector vectorOrNumber(std::string_view key, Vector fallback, Range<float> range) const
    {
        return isNumber(key) ? Vector(number(key, 0, range)) : vector(key, fallback, range);
    }
    /// Unit length; of any length in the file.
    [[nodiscard]] vec3 direction(std::string_view key, vec3 fallback) const;
    /// One of `words`; the key may be absent only where there is a fallback.
    template <class Value, size_t kCount>
    [[nodiscard]] Value choice(std::string_view key, std::optional<Value> fallback, const Words<Value, kCount>& words) const;

    /// The object under `key`, or an empty one.
    [[nodiscard]] JsonObject object(std::string_view key) const;
    /// The array under `key`, or an empty one.
    [[nodiscard]] std::vector<JsonObject> objects(std::string_view key) const;
    [[nodiscard]] std::vector<vec2> points(std::string_view key, Range<float> range) const;
    [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
    /// Keys with their values as text: numbers and booleans as written, strings without quotes.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> pairs() const;

    /// Throws Error about the value of `key`, or about the object itself where `key` is empty.
    [[noreturn]] void refuse(std::string_view key, const std::string& reason) const;

private:
    [[nodiscard]] const nlohmann::json* find(std::string_view key) const;
    [[nodiscard]] std::string placeOf(std::string_view key) const;
    [[nodiscard]] size_t indexOfWord(std::string_view key, std::span<const std::string_view> words) const;
    void readNumbers(std::string_view key, std::span<float> numbers, Range<float> range) const;
    void readNumbers(const nlohmann::json& array, std::string_view key, std::span<float> numbers, Range<float> range) const;
    [[nodiscard]] float checkedNumber(const nlohmann::json& value, std::string_view key, Range<float> range) const;

    const nlohmann::json* value_;
    Path file_;
    std::string where_; // as in "entities[2].transform", empty for the document
};

template <class Value, size_t kCount>
Value JsonObject::choice(std::string_view key, std::optional<Value> fallback, const Words<Value, kCount>& words) const
{
    if (fallback && !has(key))
        return *fallback;
    std::array<std::string_view, kCount> names;
    for (size_t i = 0; i < kCount; ++i)
        names[i] = words[i].first;
    return words[indexOfWord(key, names)].second;
}

} // namespace antumbra::scene
