// The arrows between the folders run one way (DESIGN.md, Map): read from the #include lines themselves.
#include "base/check.h"
#include "base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace antumbra {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Layer
{
    std::string folder;
    std::set<std::string> mayInclude;
};

/// Lowest first. "shaders" is shaders/shared: the structs that GLSL includes too.
const std::vector<Layer> kLayers{
    {"shaders", {}},
    {"base", {}},
    {"ecs", {"base"}},
    {"gpu", {"base", "shaders"}},
    {"graph", {"gpu", "base", "shaders"}},
    {"scene", {"ecs", "base"}},
    {"bake", {"scene", "ecs", "base", "shaders"}},
    {"render", {"graph", "gpu", "bake", "scene", "ecs", "base", "shaders"}},
    {"app", {"render", "graph", "gpu", "bake", "scene", "ecs", "base"}},
    {"game", {"app", "scene", "ecs", "base"}},
};

const Layer& layerOf(const std::string& folder)
{
    const auto found = std::ranges::find(kLayers, folder, &Layer::folder);
    check(found != kLayers.end(), "a folder of the map");
    return *found;
}

Path pathOf(const Layer& layer)
{
    return projectPath(layer.folder == "game" ? "game" : layer.folder == "shaders" ? "shaders/shared" : "engine/" + layer.folder);
}

/// The quoted paths of the #include lines.
std::vector<std::string> includesOf(const std::string& source)
{
    std::vector<std::string> paths;
    std::istringstream lines(source);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string directive;
        std::string path;
        words >> directive;
        if (directive == "#")
            words >> directive;
        if (directive != "#include" && directive != "include")
            continue;
        words >> path;
        if (path.size() > 2 && path.front() == '"')
            paths.push_back(path.substr(1, path.find('"', 1) - 1));
    }
    return paths;
}

/// One line for each include of `source`, a file of `layer`, that the map does not allow.
std::vector<std::string> wrongIncludes(const Layer& layer, const std::string& source)
{
    std::vector<std::string> wrong;
    for (const std::string& path : includesOf(source)) {
        const std::string target = path.substr(0, path.find('/'));
        if (path.find('/') == std::string::npos)
            wrong.push_back(path + " is named without its folder");
        else if (target != layer.folder && !layer.mayInclude.contains(target))
            wrong.push_back(layer.folder + " may not include " + path);
    }
    return wrong;
}

std::vector<Path> sourcesUnder(const Path& folder)
{
    std::vector<Path> sources;
    if (!std::filesystem::exists(folder))
        return sources;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
            sources.push_back(entry.path());
    return sources;
}

TEST(Layering, EveryFolderOfTheEngineIsOnTheMap)
{
    for (const auto& entry : std::filesystem::directory_iterator(projectPath("engine")))
        EXPECT_NE(std::ranges::find(kLayers, entry.path().filename().string(), &Layer::folder), kLayers.end()) << entry.path();
}

TEST(Layering, NoIncludeRunsBack)
{
    ASSERT_FALSE(sourcesUnder(pathOf(layerOf("base"))).empty()) << "no sources where the build was configured";
    for (const Layer& layer : kLayers)
        for (const Path& source : sourcesUnder(pathOf(layer)))
            EXPECT_THAT(wrongIncludes(layer, readText(source)), IsEmpty()) << source;
}

TEST(Layering, TheMapItselfHasNoCircle)
{
    std::set<std::string> lower;
    for (const Layer& layer : kLayers) {
        EXPECT_TRUE(std::ranges::includes(lower, layer.mayInclude)) << layer.folder;
        lower.insert(layer.folder);
    }
}

TEST(Layering, AnArrowThatRunsBackIsFound)
{
    EXPECT_THAT(wrongIncludes(layerOf("graph"), "#include \"render/renderer.h\"\n"),
                ElementsAre("graph may not include render/renderer.h"));
    EXPECT_THAT(wrongIncludes(layerOf("game"), "#pragma once\n#  include   \"gpu/device.h\"  // why\n"),
                ElementsAre("game may not include gpu/device.h"));
    EXPECT_THAT(wrongIncludes(layerOf("scene"), "# include \"mesh.h\"\n"), ElementsAre("mesh.h is named without its folder"));
    EXPECT_THAT(wrongIncludes(layerOf("render"), "#include \"graph/plan.h\"\n#include \"render/view.h\"\n#include <vector>\n"), IsEmpty());
}

} // namespace
} // namespace antumbra
