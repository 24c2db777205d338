// Files that were made to break loaders, with their makers' word on which of them are errors.
#include "scene/gltf.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

using namespace antumbra;
using namespace antumbra::scene;

namespace {

const Path kMalformed = Path(ANTUMBRA_SHARED_DIR) / "assets/malformed";

/// Empty when the file loads.
std::string refusalOf(const Path& path)
{
    try {
        loadGltf(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::BadInput);
        EXPECT_EQ(error.which, path.string());
        return error.what();
    }
    return "";
}

/// The first columns of a comma-separated file, its header left out.
std::vector<std::vector<std::string>> rowsOf(const Path& path)
{
    std::vector<std::vector<std::string>> rows;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::vector<std::string> row;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            row.push_back(cell);
        rows.push_back(row);
    }
    return rows;
}

std::vector<Path> modelsUnder(const Path& folder)
{
    std::vector<Path> models;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
            models.push_back(entry.path());
    std::sort(models.begin(), models.end());
    return models;
}

} // namespace

TEST(GltfMalformed, EveryListedErrorEndsInOneLine)
{
    if (!std::filesystem::exists(kMalformed))
        GTEST_SKIP() << "no " << kMalformed;
    std::map<std::string, bool> mustRefuse;
    for (const auto& row : rowsOf(kMalformed / "generated/manifest.csv"))
        mustRefuse["generated/" + row.at(0)] = row.at(1) == "reject";
    for (const auto& row : rowsOf(kMalformed / "gltf-validator/manifest.csv"))
        mustRefuse["gltf-validator/" + row.at(0)] = row.at(2) != "0";
    EXPECT_GT(mustRefuse.size(), 200u);
    for (const auto& [name, isError] : mustRefuse) {
        const std::string refusal = refusalOf(kMalformed / name);
        EXPECT_EQ(refusal.find('\n'), std::string::npos) << name;
        EXPECT_TRUE(!isError || !refusal.empty()) << name << " is an error and was accepted";
    }
}

TEST(GltfMalformed, WhatTheValidatorPassesLoads)
{
    const Path folder = kMalformed / "gltf-validator";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "no " << folder;
    // Not broken, but beyond this loader: an unknown accessor type, a newer minimum version, indices without data.
    constexpr std::string_view kBeyond[] = {"accessor/unknown_type.gltf", "asset/min_version_valid.gltf", "mesh/valid.gltf"};
    for (const auto& row : rowsOf(folder / "manifest.csv")) {
        const bool isBeyond = std::find(std::begin(kBeyond), std::end(kBeyond), row.at(0)) != std::end(kBeyond);
        const bool isValid = row.at(2) == "0";
        EXPECT_TRUE(!isValid || isBeyond || refusalOf(folder / row.at(0)).empty()) << row.at(0);
    }
}

TEST(GltfMalformed, WhatCanBeMeantInOneWayOnlyLoads)
{
    if (!std::filesystem::exists(kMalformed))
        GTEST_SKIP() << "no " << kMalformed;
    // Listed as sane because a loader may go either way; these cannot be set right without guessing.
    const std::map<std::string, std::string_view> refused{
        {"json_bom.glb", "glTF's JSON has no byte order mark"},
        {"pos_nan.glb", "no place can be read from it"},
        {"pos_inf.glb", "no place can be read from it"},
        {"pos_1e38.glb", "its positions are not those that the file was written with: their bounds say so"},
        {"node_rot_zero.glb", "a quaternion of zero is no rotation, nor nearly one"},
        {"vtx_weight_nan.glb", "no share can be read from it"},
        {"anim_times_reverse.glb", "nobody can tell whether the times or the values stand in the wrong order"},
        {"anim_times_nan.glb", "no time can be read from it"},
        {"anim_time_neg.glb", "whether the clip is to be shifted or cut, the file does not say"},
        {"anim_one_key.glb", "one value for three keys: the other two are lost"},
    };
    size_t loaded = 0;
    for (const auto& row : rowsOf(kMalformed / "generated/manifest.csv")) {
        if (row.at(1) != "sane")
            continue;
        const auto reason = refused.find(row.at(0));
        const std::string refusal = refusalOf(kMalformed / "generated" / row.at(0));
        EXPECT_EQ(refusal.empty(), reason == refused.end())
            << row.at(0) << ": " << (reason == refused.end() ? refusal : std::string(reason->second));
        loaded += refusal.empty() ? 1 : 0;
    }
    EXPECT_EQ(loaded, 6u);
}

TEST(GltfMalformed, OtherLoadersTrapsEndSanely)
{
    if (!std::filesystem::exists(kMalformed))
        GTEST_SKIP() << "no " << kMalformed;
    // These two are valid: a BIN chunk that is not empty after all, and a skin without a mesh.
    constexpr std::string_view kValid[] = {"zero-sized-bin-chunk-issue-440.glb", "issue-492.glb"};
    for (const char* folder : {"assimp", "cgltf", "tinygltf"})
        for (const Path& path : modelsUnder(kMalformed / folder)) {
            const bool isValid = std::find(std::begin(kValid), std::end(kValid), path.filename().string()) != std::end(kValid);
            EXPECT_EQ(refusalOf(path).empty(), isValid) << path;
        }
}
