#include "scene/gltf_rules.h"

#include <algorithm>
#include <set>

namespace antumbra::scene {

namespace {

constexpr int kNoParent = -1;

std::vector<int> findParents(const tinygltf::Model& file)
{
    std::vector<int> parents(file.nodes.size(), kNoParent);
    for (size_t i = 0; i < file.nodes.size(); ++i)
        for (const int child : file.nodes[i].children) {
            int& parent = parents[static_cast<size_t>(child)];
            require(parent == kNoParent, "nodes[{}] has two parents, {} and {}", child, parent, i);
            parent = static_cast<int>(i);
        }
    return parents;
}

// With one parent each, a node lies on a cycle or below one unless a root reaches it.
void checkReached(const tinygltf::Model& file, const std::vector<int>& parents)
{
    std::vector<bool> isReached(file.nodes.size());
    std::vector<int> open;
    for (size_t i = 0; i < parents.size(); ++i)
        if (parents[i] == kNoParent)
            open.push_back(static_cast<int>(i));
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        isReached[static_cast<size_t>(node)] = true;
        const std::vector<int>& children = at(file.nodes, node).children;
        open.insert(open.end(), children.begin(), children.end());
    }
    const auto lost = std::find(isReached.begin(), isReached.end(), false);
    require(lost == isReached.end(), "nodes[{}] is its own ancestor", lost - isReached.begin());
}

void checkSkin(const tinygltf::Model& file, size_t i, Repairs& repairs)
{
    const tinygltf::Skin& skin = file.skins[i];
    if (std::set(skin.joints.begin(), skin.joints.end()).size() < skin.joints.size())
        repairs.note(fmt::format("skins[{}]", i), "a node that is two joints stays two joints, each with its own matrix");
    if (skin.inverseBindMatrices < 0)
        return;
    const tinygltf::Accessor& matrices = at(file.accessors, skin.inverseBindMatrices);
    require(matrices.type == TINYGLTF_TYPE_MAT4 && matrices.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT,
            "skins[{}].inverseBindMatrices: must be float matrices of 4 x 4", i);
    require(matrices.count >= skin.joints.size(), "skins[{}].inverseBindMatrices: {} matrices for {} joints", i, matrices.count,
            skin.joints.size());
}

} // namespace

void checkNodes(const tinygltf::Model& file, Repairs& repairs)
{
    const std::vector<int> parents = findParents(file);
    checkReached(file, parents);
    for (size_t i = 0; i < file.nodes.size(); ++i) {
        const std::vector<float> rotation(file.nodes[i].rotation.begin(), file.nodes[i].rotation.end());
        require(areUnit(rotation, 4, 4), "nodes[{}].rotation: is not a unit quaternion", i);
    }
    for (size_t i = 0; i < file.scenes.size(); ++i)
        for (const int node : file.scenes[i].nodes)
            require(at(parents, node) == kNoParent, "scenes[{}]: nodes[{}] is not a root", i, node);
    for (size_t i = 0; i < file.skins.size(); ++i)
        checkSkin(file, i, repairs);
}

} // namespace antumbra::scene
