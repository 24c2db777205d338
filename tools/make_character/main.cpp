// make_character OUTPUT.glb: the walker, the same bytes every time.
#include "base/error.h"
#include "base/file.h"
#include "tools/make_character/clips.h"
#include "tools/make_character/glb.h"
#include "tools/make_character/surface.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace antumbra::character {
namespace {

// Rounded so that a last bit of another machine's mathematics does not reach the file.
vec3 rounded(const dvec3& value)
{
    constexpr double kSteps = 1 << 14;
    return vec3(glm::round(value * kSteps) / kSteps);
}

/// The four greatest weights as multiples of 1/1024 that sum to one.
scene::Influence influenceOf(const std::array<double, kJointCount>& weights)
{
    constexpr double kSteps = 1024;
    std::array<uint16_t, kJointCount> order{};
    std::iota(order.begin(), order.end(), uint16_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](uint16_t joint) { return std::round(weights[joint] * kSteps); });

    scene::Influence influence;
    const double sum = weights[order[0]] + weights[order[1]] + weights[order[2]] + weights[order[3]];
    double rest = kSteps;
    for (size_t i = 3; i > 0; --i) {
        const double share = std::round(weights[order[i]] / sum * kSteps);
        influence.joints[i] = share > 0 ? order[i] : uint16_t{0};
        influence.weights[i] = static_cast<float>(share / kSteps);
        rest -= share;
    }
    influence.joints[0] = order[0];
    influence.weights[0] = static_cast<float>(rest / kSteps);
    return influence;
}

scene::Mesh skinnedMesh(const Surface& surface)
{
    scene::Mesh mesh;
    for (const auto& weights : skinWeights(surface))
        mesh.influences.push_back(influenceOf(weights));
    for (const dvec3& position : surface.positions) {
        mesh.positions.push_back(rounded(position));
        mesh.normals.push_back(rounded(normalOfBody(position)));
    }
    for (const glm::uvec3& t : surface.triangles) {
        const dvec3 centre = (surface.positions[t.x] + surface.positions[t.y] + surface.positions[t.z]) / 3.0;
        mesh.indices.insert(mesh.indices.end(), {t.x, t.y, t.z});
        mesh.triangleMaterials.push_back(clothAt(ontoBody(centre)));
    }
    return mesh;
}

scene::Model makeWalker()
{
    scene::Model model;
    model.name = "walker";
    model.mesh = skinnedMesh(remesh(polygonise(0.012)));
    for (uint32_t i = 0; i < kJointCount; ++i) {
        const JointPlace& place = skeleton()[i];
        const bool isRoot = place.parent == i;
        model.nodes.push_back({.name = place.name,
                               .parent = isRoot ? scene::kNoIndex : uint32_t{place.parent},
                               .rest = {.translation = rounded(isRoot ? place.bind : bindOffset(place.parent, Joint(i)))}});
        model.joints.push_back({.node = i, .inverseBind = glm::translate(mat4{1}, -rounded(place.bind))});
    }
    model.materials.resize(kClothCount);
    model.materials[Skin] = {.albedo = {0.56f, 0.35f, 0.25f}, .roughness = 0.55f};
    model.materials[Shirt] = {.albedo = {0.62f, 0.58f, 0.5f}, .roughness = 0.9f};
    model.materials[Trousers] = {.albedo = {0.09f, 0.14f, 0.24f}, .roughness = 0.9f};
    model.materials[Leather] = {.albedo = {0.07f, 0.045f, 0.03f}, .roughness = 0.6f};
    for (const Motion& motion : motions())
        model.clips.push_back(toClip(motion));
    return model;
}

} // namespace
} // namespace antumbra::character

int main(int argumentCount, char** arguments)
{
    using namespace antumbra;
    if (argumentCount != 2) {
        fmt::print(stderr, "usage: make_character OUTPUT.glb\n");
        return static_cast<int>(ExitCode::BadInput);
    }
    try {
        const scene::Model walker = character::makeWalker();
        const std::vector<std::byte> bytes = character::toGlb(walker);
        writeFile(arguments[1], bytes);
        fmt::print("{}: {} triangles, {} vertices, {} joints, {} clips, {} bytes\n", arguments[1], walker.mesh.indices.size() / 3,
                   walker.mesh.positions.size(), walker.joints.size(), walker.clips.size(), bytes.size());
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code);
    }
    return static_cast<int>(ExitCode::Done);
}
