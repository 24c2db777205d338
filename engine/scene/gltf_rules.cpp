#include "scene/gltf_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace antumbra::scene {

namespace {

constexpr std::string_view kRefused[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"};
constexpr std::string_view kUnderstood[] = {"KHR_mesh_quantization", "KHR_materials_unlit", "KHR_materials_emissive_strength",
                                            "KHR_texture_transform"};

bool isAmong(std::span<const std::string_view> names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

struct Version
{
    int major = 0;
    int minor = 0;
};

Version parseVersion(const std::string& text)
{
    Version version;
    int used = 0;
    const bool isRead = std::sscanf(text.c_str(), "%5d.%5d%n", &version.major, &version.minor, &used) == 2;
    require(isRead && static_cast<size_t>(used) == text.size(), "version \"{}\" is not of the form 2.0", text);
    return version;
}

} // namespace

void checkVersionAndExtensions(const Json& root)
{
    const Json& asset = root["asset"];
    const Version version = parseVersion(asset["version"]);
    require(version.major == 2, "glTF version {} is not 2", asset["version"].get<std::string>());
    if (asset.contains("minVersion")) {
        const Version least = parseVersion(asset["minVersion"]);
        require(least.major < 2 || (least.major == 2 && least.minor == 0), "glTF version {} is required, 2.0 is understood",
                asset["minVersion"].get<std::string>());
    }

    const auto used = root.value("extensionsUsed", std::vector<std::string>{});
    for (const std::string& name : used)
        require(!isAmong(kRefused, name), "{} is not supported", name);
    for (const auto& name : root.value("extensionsRequired", std::vector<std::string>{})) {
        require(std::find(used.begin(), used.end(), name) != used.end(), "extension {} is required but not listed as used", name);
        require(isAmong(kUnderstood, name), "the required extension {} is not supported", name);
    }
}

void checkCameras(const tinygltf::Model& file)
{
    for (size_t i = 0; i < file.cameras.size(); ++i) {
        const tinygltf::Camera& camera = file.cameras[i];
        const bool isFlat = camera.type == "orthographic";
        const double nearest = isFlat ? camera.orthographic.znear : camera.perspective.znear;
        const double farthest = isFlat ? camera.orthographic.zfar : camera.perspective.zfar;
        const bool isInfinite = !isFlat && farthest == 0;
        require(isInfinite || farthest > nearest, "cameras[{}]: zfar must be greater than znear", i);
    }
}

bool areUnit(std::span<const float> values, size_t width, size_t length)
{
    for (size_t i = 0; i + width <= values.size(); i += width) {
        double squares = 0;
        for (size_t j = 0; j < length; ++j)
            squares += double{values[i + j]} * values[i + j];
        if (std::abs(std::sqrt(squares) - 1) > kUnitTolerance)
            return false;
    }
    return true;
}

} // namespace antumbra::scene
