#include "graph/dot.h"

#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace antumbra::graph {

namespace {

using Json = nlohmann::ordered_json;

/// A version as the picture shows it: the first of its resource has ordinal 1.
struct VersionNode
{
    uint32_t resource = kNone;
    uint32_t ordinal = 0;
    bool isUsed = false; // by a pass that runs
};

std::vector<bool> passesThatRun(const FrameGraph& graph, const Plan& plan)
{
    std::vector<bool> runs(graph.passes().size(), false);
    for (const Step& step : plan.steps)
        runs[step.pass] = true;
    return runs;
}

std::vector<VersionNode> versionNodes(const FrameGraph& graph, const std::vector<bool>& runs)
{
    std::vector<VersionNode> nodes(graph.versionCount());
    std::vector<uint32_t> count(graph.resources().size(), 0);
    for (size_t pass = 0; pass < graph.passes().size(); ++pass)
        for (const Access& access : graph.accesses(graph.passes()[pass]))
            for (const uint32_t version : {access.before, access.after}) {
                if (version == kNone)
                    continue;
                VersionNode& node = nodes[version];
                if (node.resource == kNone)
                    node = {.resource = access.resource, .ordinal = ++count[access.resource]};
                node.isUsed |= runs[pass];
            }
    return nodes;
}

std::string escaped(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += '\\';
        result += c;
    }
    return result;
}

constexpr std::string_view kAbsentStyle = "style=dashed, color=gray60, fontcolor=gray60";

void drawVersions(std::string& dot, const FrameGraph& graph, std::span<const VersionNode> nodes)
{
    for (size_t version = 0; version < nodes.size(); ++version) {
        const VersionNode& node = nodes[version];
        if (node.resource == kNone)
            continue;
        const Resource& resource = graph.resources()[node.resource];
        const std::string ordinal = node.ordinal > 1 ? fmt::format(" #{}", node.ordinal) : "";
        fmt::format_to(std::back_inserter(dot), "    v{} [label=\"{}{}\", peripheries={}{}{}];\n", version, escaped(resource.label),
                       ordinal, resource.origin == Origin::Transient ? 1 : 2, node.isUsed ? "" : ", ", node.isUsed ? "" : kAbsentStyle);
    }
}

void drawAccesses(std::string& dot, const FrameGraph& graph, size_t pass, bool runs)
{
    const std::string_view style = runs ? std::string_view{} : kAbsentStyle;
    for (const Access& access : graph.accesses(graph.passes()[pass])) {
        const std::string label = fmt::format("label=\"{}\"{}{}", nameOf(access.use), runs ? "" : ", ", style);
        if (access.before != kNone)
            fmt::format_to(std::back_inserter(dot), "    v{} -> p{} [{}];\n", access.before, pass, label);
        if (access.after != kNone)
            fmt::format_to(std::back_inserter(dot), "    p{} -> v{} [{}];\n", pass, access.after, label);
    }
}

void drawAbsent(std::string& dot, std::string_view id, const AbsentPass& pass)
{
    fmt::format_to(std::back_inserter(dot), "    {} [shape=box, label=\"{}\\n{}\", {}];\n", id, escaped(pass.name), escaped(reasonOf(pass)),
                   kAbsentStyle);
}

std::string_view nameOf(gpu::Format format)
{
    switch (format) {
    case gpu::Format::Undefined: return "undefined";
    case gpu::Format::R8Unorm: return "r8 unorm";
    case gpu::Format::Rgba8Unorm: return "rgba8 unorm";
    case gpu::Format::Rgba8Srgb: return "rgba8 srgb";
    case gpu::Format::Bgra8Unorm: return "bgra8 unorm";
    case gpu::Format::Bgra8Srgb: return "bgra8 srgb";
    case gpu::Format::R16Float: return "r16 float";
    case gpu::Format::Rg16Float: return "rg16 float";
    case gpu::Format::Rgba16Float: return "rgba16 float";
    case gpu::Format::Rgba16Snorm: return "rgba16 snorm";
    case gpu::Format::R32Float: return "r32 float";
    case gpu::Format::Rg32Float: return "rg32 float";
    case gpu::Format::Rgba32Float: return "rgba32 float";
    case gpu::Format::R32Uint: return "r32 uint";
    case gpu::Format::Rg32Uint: return "rg32 uint";
    case gpu::Format::Rgba32Uint: return "rgba32 uint";
    case gpu::Format::Depth32Float: return "depth32 float";
    }
    return "undefined";
}

std::string_view nameOf(Kind kind) { return kind == Kind::Image ? "image" : "buffer"; }

std::string_view nameOf(Origin origin)
{
    switch (origin) {
    case Origin::Transient: return "transient";
    case Origin::Imported: return "imported";
    case Origin::HistoryBefore: return "history before";
    case Origin::HistoryNow: return "history now";
    }
    return "transient";
}

Json orNull(uint32_t number) { return number == kNone ? Json{} : Json(number); }

Json namesOf(UseSet uses)
{
    Json names = Json::array();
    uses.forEach([&](Use use) { names.push_back(nameOf(use)); });
    return names;
}

/// The accesses of a pass that read, or those that write.
Json accessesOf(const FrameGraph& graph, const PassNode& pass, bool thatWrite)
{
    Json accesses = Json::array();
    for (const Access& access : graph.accesses(pass))
        if (writes(access.use) == thatWrite)
            accesses.push_back({{"resource", graph.resources()[access.resource].label}, {"use", nameOf(access.use)}});
    return accesses;
}

Json passesOf(const FrameGraph& graph, const Plan& plan)
{
    Json passes = Json::array();
    for (const Step& step : plan.steps) {
        const PassNode& pass = graph.passes()[step.pass];
        passes.push_back(
            {{"name", pass.name}, {"culled", false}, {"reads", accessesOf(graph, pass, false)}, {"writes", accessesOf(graph, pass, true)}});
    }
    for (const AbsentPass& pass : plan.absent)
        passes.push_back({{"name", pass.name}, {"culled", true}, {"reason", reasonOf(pass)}});
    return passes;
}

Json resourcesOf(const FrameGraph& graph, const Plan& plan)
{
    Json resources = Json::array();
    for (size_t i = 0; i < plan.resources.size(); ++i) {
        const Resource& resource = graph.resources()[i];
        const PlannedResource& planned = plan.resources[i];
        const bool isImage = resource.kind == Kind::Image;
        const uvec2 extent = resource.image.extent;
        resources.push_back({{"label", resource.label},
                             {"kind", nameOf(resource.kind)},
                             {"format", isImage ? Json(nameOf(resource.image.format)) : Json{}},
                             {"extent", isImage ? Json{extent.x, extent.y} : Json{}},
                             {"origin", nameOf(resource.origin)},
                             {"bytes", resource.bytes},
                             {"first", orNull(planned.first)},
                             {"last", orNull(planned.last)},
                             {"memory", orNull(planned.memory)}});
    }
    return resources;
}

void listBarriers(Json& barriers, const FrameGraph& graph, std::span<const Barrier> some, std::string_view before)
{
    for (const Barrier& barrier : some)
        barriers.push_back({{"before", before},
                            {"resource", graph.resources()[barrier.resource].label},
                            {"from", namesOf(barrier.from)},
                            {"to", namesOf(barrier.to)},
                            {"discard", barrier.discard}});
}

} // namespace

std::string toDot(const FrameGraph& graph, const Plan& plan)
{
    const std::vector<bool> runs = passesThatRun(graph, plan);
    std::string dot = "digraph frame {\n    rankdir=LR;\n    node [fontname=\"sans-serif\", shape=ellipse];\n";
    drawVersions(dot, graph, versionNodes(graph, runs));

    size_t absent = 0; // the culled ones come first, in the order of declaration
    for (size_t pass = 0; pass < graph.passes().size(); ++pass) {
        if (runs[pass])
            fmt::format_to(std::back_inserter(dot), "    p{} [shape=box, label=\"{}\"];\n", pass, escaped(graph.passes()[pass].name));
        else
            drawAbsent(dot, fmt::format("p{}", pass), plan.absent[absent++]);
        drawAccesses(dot, graph, pass, runs[pass]);
    }
    for (; absent < plan.absent.size(); ++absent)
        drawAbsent(dot, fmt::format("skipped{}", absent), plan.absent[absent]);
    return dot + "}\n";
}

std::string toJson(const FrameGraph& graph, const Plan& plan)
{
    Json memory = Json::array();
    for (const SharedMemory& shared : plan.memory)
        memory.push_back({{"kind", nameOf(shared.kind)}, {"bytes", shared.bytes}});
    Json barriers = Json::array();
    for (const Step& step : plan.steps)
        listBarriers(barriers, graph, plan.barriersOf(step.barriers), graph.passes()[step.pass].name);
    listBarriers(barriers, graph, plan.barriersOf(plan.finalBarriers), "the end of the frame");
    return Json{{"passes", passesOf(graph, plan)}, {"resources", resourcesOf(graph, plan)}, {"memory", memory}, {"barriers", barriers}}
        .dump(2);
}

} // namespace antumbra::graph
