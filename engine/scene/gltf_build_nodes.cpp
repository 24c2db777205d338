#include "scene/gltf_build.h"

#include "scene/gltf_rules.h"

namespace antumbra::scene {

namespace {

vec3 vectorOr(const std::vector<double>& values, vec3 fallback)
{
    return values.empty() ? fallback : vec3(values[0], values[1], values[2]);
}

quat rotationOf(const std::vector<double>& xyzw)
{
    if (xyzw.empty())
        return {1, 0, 0, 0};
    const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    return quat(glm::normalize(rotation));
}

// glTF allows only matrices that are a translation, a rotation and a scale; of others the shear is lost.
NodePose decompose(const mat4& matrix)
{
    mat3 axes(matrix);
    vec3 scale{glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])};
    if (glm::determinant(axes) < 0)
        scale.x = -scale.x;
    const bool isSingular = scale.x == 0 || scale.y == 0 || scale.z == 0;
    for (int i = 0; i < 3 && !isSingular; ++i)
        axes[i] /= scale[i];
    return {vec3(matrix[3]), isSingular ? quat(1, 0, 0, 0) : glm::normalize(glm::quat_cast(axes)), scale};
}

NodePose restOf(const tinygltf::Node& node)
{
    if (node.matrix.empty())
        return {vectorOr(node.translation, vec3{0}), rotationOf(node.rotation), vectorOr(node.scale, vec3{1})};
    mat4 matrix;
    for (int i = 0; i < 16; ++i)
        matrix[i / 4][i % 4] = static_cast<float>(node.matrix[static_cast<size_t>(i)]);
    return decompose(matrix);
}

} // namespace

void addNodes(Model& model, Placement& placement, const tinygltf::Model& file)
{
    std::vector<int> parents(file.nodes.size(), -1);
    for (size_t i = 0; i < file.nodes.size(); ++i)
        for (const int child : file.nodes[i].children)
            parents[static_cast<size_t>(child)] = static_cast<int>(i);

    std::vector<int> order;
    for (size_t i = 0; i < parents.size(); ++i)
        if (parents[i] < 0)
            order.push_back(static_cast<int>(i));
    for (size_t i = 0; i < order.size(); ++i) {
        const std::vector<int>& children = at(file.nodes, order[i]).children;
        order.insert(order.end(), children.begin(), children.end());
    }

    placement.nodes.assign(file.nodes.size(), kNoIndex);
    placement.firstMorphs.assign(file.nodes.size(), kNoIndex);
    for (const int index : order) {
        const tinygltf::Node& node = at(file.nodes, index);
        const int parent = at(parents, index);
        placement.nodes[static_cast<size_t>(index)] = static_cast<uint32_t>(model.nodes.size());
        model.nodes.push_back({node.name, parent < 0 ? kNoIndex : at(placement.nodes, parent), restOf(node)});
    }
    if (model.nodes.empty())
        model.nodes.push_back({});
}

} // namespace antumbra::scene
