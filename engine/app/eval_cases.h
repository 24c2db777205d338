// A file of cases, read strictly and handed out in batches, so that any number of them fits the device.
#pragma once

#include "scene/json_object.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <span>

namespace antumbra::app {

/// One case: its checked view, and the value itself for answers that may be null.
struct EvalCase
{
    scene::JsonObject object;
    const nlohmann::json& value;
    const Path& file;
    std::string id;

    /// Throw Error where the key is missing.
    [[nodiscard]] vec3 vector(std::string_view key) const;
    [[nodiscard]] vec3 unitVector(std::string_view key) const;
    /// The array under `key`, where null stands for nothing.
    [[nodiscard]] std::vector<std::optional<scene::JsonObject>> objectsOrNulls(std::string_view key) const;
};

class EvalCases
{
public:
    static constexpr size_t kBatch = 1024;

    /// Throws Error for a file without "cases", or a case without an id. What else a case holds is its kind's business.
    explicit EvalCases(const Path& file);
    EvalCases(const EvalCases&) = delete;
    EvalCases& operator=(const EvalCases&) = delete;

    [[nodiscard]] size_t size() const { return cases_.size(); }
    /// Cases [first, first + kBatch), fewer at the end.
    [[nodiscard]] std::span<const EvalCase> batch(size_t first) const;

private:
    Path file_;
    nlohmann::json document_;
    std::vector<EvalCase> cases_; // into both
};

/// A sphere of a case: {"center", "radius"}.
struct EvalSphere
{
    vec3 centre;
    float radius;
};
EvalSphere sphereOf(const scene::JsonObject& object);

} // namespace antumbra::app
