#include "app/eval_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace antumbra::app {

namespace {

constexpr scene::Range<float> kAnyPlace{-1e9f, 1e9f};
constexpr scene::Range<float> kAnyRadius{0, 1e9f};

vec3 requiredVector(const scene::JsonObject& object, std::string_view key)
{
    if (!object.has(key))
        object.refuse(key, "is missing");
    return object.vector(key, vec3(0), kAnyPlace);
}

} // namespace

vec3 EvalCase::vector(std::string_view key) const { return requiredVector(object, key); }

vec3 EvalCase::unitVector(std::string_view key) const
{
    const vec3 direction = vector(key);
    if (!(std::abs(glm::length(direction) - 1.0f) < 1e-3f))
        object.refuse(key, "is not of unit length");
    return glm::normalize(direction);
}

std::vector<std::optional<scene::JsonObject>> EvalCase::objectsOrNulls(std::string_view key) const
{
    const auto array = value.find(key);
    if (array == value.end() || !array->is_array())
        object.refuse(key, "expected an array");
    std::vector<std::optional<scene::JsonObject>> objects(array->size());
    for (size_t i = 0; i < objects.size(); ++i)
        if (!(*array)[i].is_null())
            objects[i].emplace((*array)[i], file, fmt::format("{}: {}[{}]", id, key, i));
    return objects;
}

EvalSphere sphereOf(const scene::JsonObject& object)
{
    if (!object.has("radius"))
        object.refuse("radius", "is missing");
    return {requiredVector(object, "center"), object.number("radius", 0, kAnyRadius)};
}

EvalCases::EvalCases(const Path& file) : file_(file), document_(scene::parseJson(file))
{
    const scene::JsonObject root(document_, file, "");
    if (!root.has("cases"))
        root.refuse("cases", "is missing");
    const std::vector<scene::JsonObject> objects = root.objects("cases");
    const nlohmann::json& values = document_["cases"];
    cases_.reserve(objects.size());
    for (size_t i = 0; i < objects.size(); ++i) {
        cases_.push_back({objects[i], values[i], file_, objects[i].text("id", "")});
        if (cases_.back().id.empty())
            objects[i].refuse("id", "is missing");
    }
}

std::span<const EvalCase> EvalCases::batch(size_t first) const
{
    return std::span(cases_).subspan(first, std::min(kBatch, cases_.size() - first));
}

} // namespace antumbra::app
