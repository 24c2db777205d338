#include "app/area_problem.h"

#include <algorithm>
#include <cmath>

namespace antumbra::app {

namespace {

using nlohmann::json;
using scene::JsonObject;

// What the device has room for.
constexpr size_t kMostLightVertices = 62;
constexpr size_t kMostFaces = 320;

/// `count` finite numbers under a key or in an array.
std::vector<float> numbers(const json& array, const JsonObject& owner, std::string_view key, size_t count)
{
    const auto isNumber = [](const json& each) { return each.is_number() && std::abs(each.get<double>()) <= 1e9; };
    if (!array.is_array() || array.size() != count || !std::ranges::all_of(array, isNumber))
        owner.refuse(key, "expected arrays of " + std::to_string(count) + " numbers");
    std::vector<float> values;
    for (const json& each : array)
        values.push_back(each.get<float>());
    return values;
}

std::vector<vec3> readVertices(const json& value, const JsonObject& owner)
{
    std::vector<vec3> vertices;
    for (const json& each : value.value("vertices", json::array())) {
        const std::vector<float> xyz = numbers(each, owner, "vertices", 3);
        vertices.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
    return vertices;
}

std::vector<scene::Loop> readFaces(const json& value, const JsonObject& owner, size_t vertexCount)
{
    std::vector<scene::Loop> faces;
    for (const json& each : value.value("faces", json::array())) {
        const auto isVertex = [&](const json& index) { return index.is_number_unsigned() && index.get<size_t>() < vertexCount; };
        if (!each.is_array() || each.size() < 3 || !std::ranges::all_of(each, isVertex))
            owner.refuse("faces", "expected arrays of three vertices and more");
        faces.push_back(each.get<scene::Loop>());
    }
    if (faces.empty() || faces.size() > kMostFaces)
        owner.refuse("faces", "expected 1 to " + std::to_string(kMostFaces));
    return faces;
}

scene::ConvexBody linked(std::vector<vec3> vertices, const std::vector<scene::Loop>& faces, const JsonObject& owner)
{
    std::optional<scene::ConvexBody> body = scene::linkedBody(std::move(vertices), faces);
    if (!body)
        owner.refuse("faces", "an edge is run through twice in one direction");
    return *std::move(body);
}

void addTriangles(std::vector<AreaOccluder>& to, const std::vector<vec3>& vertices, const std::vector<scene::Loop>& faces, bool isClosed)
{
    const scene::Loop triangle[] = {{0, 1, 2}};
    for (const scene::Loop& face : faces)
        for (size_t i = 1; i + 1 < face.size(); ++i)
            to.push_back({scene::makeBody({vertices[face[0]], vertices[face[i]], vertices[face[i + 1]]}, triangle), isClosed});
}

void addOccluder(std::vector<AreaOccluder>& to, const json& value, const JsonObject& owner)
{
    enum class Kind { Convex, Closed, Open };
    constexpr scene::Words<Kind, 4> kKinds{
        {{"card", Kind::Open}, {"convex", Kind::Convex}, {"closed", Kind::Closed}, {"open", Kind::Open}}};
    const Kind kind = owner.choice<Kind>("kind", std::nullopt, kKinds);
    std::vector<vec3> vertices = readVertices(value, owner);
    const std::vector<scene::Loop> faces = readFaces(value, owner, vertices.size());
    if (kind != Kind::Convex) {
        addTriangles(to, vertices, faces, kind == Kind::Closed);
        return;
    }
    to.push_back({linked(std::move(vertices), faces, owner)});
    if (!scene::isClosed(to.back().body))
        owner.refuse("faces", "expected a closed mesh");
}

} // namespace

AreaProblem areaProblemOf(const EvalCase& from)
{
    AreaProblem problem{.position = from.vector("x"), .normal = from.vector("normal"), .tangent = from.vector("tangent")};
    const std::vector<float> rows = numbers(from.value.value("ltc_inv", json()), from.object, "ltc_inv", 9);
    for (size_t row = 0; row < 3; ++row)
        problem.lobe[row] = {rows[3 * row], rows[3 * row + 1], rows[3 * row + 2]};
    const JsonObject light = from.object.object("light");
    const json lightValue = from.value.value("light", json::object());
    std::vector<vec3> vertices = readVertices(lightValue, light);
    if (vertices.size() > kMostLightVertices)
        light.refuse("vertices", "expected at most " + std::to_string(kMostLightVertices));
    const std::vector<scene::Loop> faces = readFaces(lightValue, light, vertices.size());
    problem.light = linked(std::move(vertices), faces, light);
    if (!problem.light.isPlanar && !scene::isClosed(problem.light))
        light.refuse("faces", "expected one face or a closed mesh");
    problem.isTwoSided = light.flag("two_sided", false);
    const std::vector<JsonObject> occluders = from.object.objects("occluders");
    for (size_t i = 0; i < occluders.size(); ++i)
        addOccluder(problem.occluders, from.value["occluders"][i], occluders[i]);
    return problem;
}

shader::AreaCase deviceCase(const AreaProblem& problem, render::BodyBlocks& bodies, const mat4& toWorld)
{
    shader::AreaCase made{.position = problem.position, .normal = problem.normal, .tangent = problem.tangent};
    for (size_t row = 0; row < 3; ++row)
        made.lobe[row] = problem.lobe[row];
    made.light = bodies.add(problem.light, toWorld, problem.isTwoSided ? shader::kBodyTwoSided : 0u);
    made.firstOccluder = static_cast<uint32_t>(bodies.bodies.size());
    made.occluderCount = static_cast<uint32_t>(problem.occluders.size());
    for (const AreaOccluder& occluder : problem.occluders)
        bodies.add(occluder.body, toWorld, occluder.isFrontOnly ? shader::kBodyFrontOnly : 0u);
    return made;
}

gpu::Pipeline areaPipeline(gpu::Device& device)
{
    constexpr gpu::ShaderDefine inScratch{"IN_SCRATCH"};
    return gpu::computePipeline(device, "eval_area.comp", std::span(&inScratch, device.info().isCpu ? 0 : 1));
}

gpu::Buffer areaScratch(gpu::Device& device, size_t count)
{
    return device.info().isCpu ? gpu::Buffer{} : gpu::Buffer(device, "area scratch", count * shader::kAreaScratchBytes);
}

} // namespace antumbra::app
