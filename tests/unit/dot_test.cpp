#include "graph/dot.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace antumbra::graph {
namespace {

constexpr ImageDesc kImage{.format = gpu::Format::Rgba16Float, .extent = {64, 32}};

void declareFrame(FrameGraph& graph)
{
    const ImageRef window = graph.import("window", {.format = gpu::Format::Bgra8Srgb, .extent = {64, 32}}, ImportedImage{1}, {});
    const ImageRef occluded = graph.add("occlusion trace").create("occluded \"irradiance\"", kImage, Use::StorageWrite);
    std::ignore = graph.add("normals view").create("normals", kImage, Use::StorageWrite);
    graph.skip("sdf shadow", "no SDFPrimitive");
    Pass compose = graph.add("compose");
    compose.read(occluded, Use::Sampled);
    graph.output(compose.write(window, Use::ColorAttachment), Use::Present);
}

/// Lines that declare a node or an edge, each ended by a semicolon, with its brackets and quotes closed.
bool isWellFormed(const std::string& dot)
{
    int depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < dot.size(); ++i) {
        if (quoted && dot[i] == '\\') {
            ++i;
            continue;
        }
        if (dot[i] == '"')
            quoted = !quoted;
        if (quoted)
            continue;
        depth += dot[i] == '{' || dot[i] == '[' ? 1 : 0;
        depth -= dot[i] == '}' || dot[i] == ']' ? 1 : 0;
        if (depth < 0)
            return false;
    }
    return depth == 0 && !quoted && dot.starts_with("digraph") && dot.ends_with("}\n");
}

std::string lineWith(const std::string& text, std::string_view what)
{
    const size_t at = text.find(what);
    if (at == std::string::npos)
        return {};
    const size_t begin = text.rfind('\n', at) + 1;
    return text.substr(begin, text.find('\n', at) - begin);
}

TEST(Dot, DrawsPassesResourcesAndWhatIsAbsent)
{
    FrameGraph graph;
    declareFrame(graph);
    const std::string dot = toDot(graph, compile(graph));
    EXPECT_TRUE(isWellFormed(dot)) << dot;

    EXPECT_NE(lineWith(dot, "label=\"compose\"").find("shape=box"), std::string::npos) << dot;
    EXPECT_EQ(lineWith(dot, "label=\"compose\"").find("dashed"), std::string::npos) << dot;
    EXPECT_NE(lineWith(dot, "occluded \\\"irradiance\\\"").find("peripheries=1"), std::string::npos) << dot;
    EXPECT_NE(lineWith(dot, "label=\"window #2\"").find("peripheries=2"), std::string::npos) << dot;
    EXPECT_NE(lineWith(dot, "normals view\\nnothing reads 'normals'").find("dashed"), std::string::npos) << dot;
    EXPECT_NE(lineWith(dot, "label=\"normals\"").find("dashed"), std::string::npos) << dot;
    EXPECT_NE(lineWith(dot, "sdf shadow\\nno SDFPrimitive").find("dashed"), std::string::npos) << dot;
}

TEST(Dot, DrawsAnEdgeForEachAccess)
{
    FrameGraph graph;
    declareFrame(graph);
    const std::string dot = toDot(graph, compile(graph));
    size_t edges = 0;
    for (size_t at = dot.find("->"); at != std::string::npos; at = dot.find("->", at + 1))
        ++edges;
    EXPECT_EQ(edges, 5u) << "two creations, a read, and a write with the version it retires";
}

TEST(Json, TellsThePlan)
{
    FrameGraph graph;
    declareFrame(graph);
    const nlohmann::json json = nlohmann::json::parse(toJson(graph, compile(graph)));

    ASSERT_EQ(json["passes"].size(), 4u);
    const auto passNamed = [&](std::string_view name) {
        return *std::ranges::find_if(json["passes"], [&](const nlohmann::json& pass) { return pass["name"] == name; });
    };
    EXPECT_EQ(passNamed("compose")["culled"], false);
    EXPECT_EQ(passNamed("compose")["reads"][0]["resource"], "occluded \"irradiance\"");
    EXPECT_EQ(passNamed("compose")["writes"][0]["use"], "color attachment");
    EXPECT_EQ(passNamed("normals view")["culled"], true);
    EXPECT_EQ(passNamed("normals view")["reason"], "nothing reads 'normals'");
    EXPECT_EQ(passNamed("sdf shadow")["reason"], "no SDFPrimitive");

    ASSERT_EQ(json["resources"].size(), 3u);
    const nlohmann::json& window = json["resources"][0];
    EXPECT_EQ(window["origin"], "imported");
    EXPECT_TRUE(window["memory"].is_null());
    const nlohmann::json& occluded = json["resources"][1];
    EXPECT_EQ(occluded["format"], "rgba16 float");
    EXPECT_EQ(occluded["extent"], (nlohmann::json{64, 32}));
    EXPECT_EQ(occluded["bytes"], 64 * 32 * 8);
    EXPECT_EQ(occluded["first"], 0);
    EXPECT_EQ(occluded["last"], 1);
    EXPECT_EQ(occluded["memory"], 0);
    EXPECT_TRUE(json["resources"][2]["first"].is_null()) << "only a culled pass uses it";

    ASSERT_EQ(json["barriers"].size(), 4u);
    EXPECT_EQ(json["barriers"][3]["before"], "the end of the frame");
    EXPECT_EQ(json["barriers"][3]["to"], nlohmann::json{"present"});
    EXPECT_EQ(json["memory"].size(), 1u);
}

} // namespace
} // namespace antumbra::graph
