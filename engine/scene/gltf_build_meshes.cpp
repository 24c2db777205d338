#include "scene/gltf_build.h"

#include "scene/animation.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_rules.h"

#include <numeric>

namespace antumbra::scene {

namespace {

constexpr size_t kMostVertices = size_t{1} << 24;
constexpr size_t kMostIndices = size_t{3} << 24;
constexpr size_t kMostJoints = size_t{1} << 16; // Influence keeps 16 bits

std::vector<int> rootsOf(const tinygltf::Model& file)
{
    if (!file.scenes.empty())
        return at(file.scenes, std::max(file.defaultScene, 0)).nodes;
    std::vector<bool> isChild(file.nodes.size());
    for (const tinygltf::Node& node : file.nodes)
        for (const int child : node.children)
            isChild[static_cast<size_t>(child)] = true;
    std::vector<int> roots;
    for (size_t i = 0; i < isChild.size(); ++i)
        if (!isChild[i])
            roots.push_back(static_cast<int>(i));
    return roots;
}

std::vector<mat4> restMatrices(const Model& model)
{
    LocalPose pose;
    setRest(pose, model);
    std::vector<mat4> joints(model.joints.size());
    std::vector<mat4> nodeToModel;
    resolve(joints, nodeToModel, pose, model);
    return nodeToModel;
}

/// Appends the meshes of nodes to the one mesh of the model.
class MeshMerge
{
public:
    MeshMerge(Model& model, Placement& placement, const tinygltf::Model& file)
        : model_(model), placement_(placement), file_(file), nodeToModel_(restMatrices(model)), firstJoints_(file.skins.size(), kNoIndex)
    {
    }

    void addTree(int root)
    {
        std::vector<int> open{root};
        while (!open.empty()) {
            const int index = open.back();
            open.pop_back();
            const tinygltf::Node& node = at(file_.nodes, index);
            if (node.mesh >= 0)
                addInstance(node, static_cast<size_t>(index));
            open.insert(open.end(), node.children.rbegin(), node.children.rend());
        }
    }

private:
    void addInstance(const tinygltf::Node& node, size_t index)
    {
        const tinygltf::Mesh& mesh = at(file_.meshes, node.mesh);
        const auto firstVertex = static_cast<uint32_t>(model_.mesh.positions.size());
        const size_t firstMorph = model_.mesh.morphTargets.size();
        model_.mesh.morphTargets.resize(firstMorph + mesh.primitives.front().targets.size(), {firstVertex, {}, {}});
        rigidJoint_ = kNoIndex;
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            addPrimitive(primitive, node, placement_.nodes[index], firstMorph);
        addRestWeights(node, mesh);
        if (model_.mesh.morphTargets.size() != firstMorph)
            placement_.firstMorphs[index] = static_cast<uint32_t>(firstMorph);
    }

    void addPrimitive(const tinygltf::Primitive& primitive, const tinygltf::Node& node, uint32_t modelNode, size_t firstMorph)
    {
        TriangleList list = readTriangles(file_, primitive);
        if (list.indices.empty())
            return;
        Mesh& mesh = model_.mesh;
        require(mesh.positions.size() + list.positions.size() <= kMostVertices && mesh.indices.size() + list.indices.size() <= kMostIndices,
                "the scene has more than {} vertices or {} triangles", kMostVertices, kMostIndices / 3);
        const bool isSkinned = node.skin >= 0 && !list.influences.empty();
        // A mirrored rigid part turns its triangles inside out; a skin's matrices place it, not its node.
        if (!isSkinned && glm::determinant(mat3(nodeToModel_[modelNode])) < 0)
            for (size_t i = 0; i < list.indices.size(); i += 3)
                std::swap(list.indices[i + 1], list.indices[i + 2]);
        appendInfluences(list, isSkinned ? skinJoints(node.skin) : rigidJoint(modelNode), isSkinned);
        appendMorphs(list, firstMorph);
        appendTriangles(list, materialOf(primitive));
        appendStreams(list);
    }

    uint32_t addJoints(size_t count)
    {
        const size_t first = model_.joints.size();
        require(first + count <= kMostJoints, "the scene has more than {} joints and rigid parts", kMostJoints);
        model_.joints.resize(first + count);
        return static_cast<uint32_t>(first);
    }

    uint32_t rigidJoint(uint32_t modelNode)
    {
        if (rigidJoint_ == kNoIndex) {
            rigidJoint_ = addJoints(1);
            model_.joints[rigidJoint_].node = modelNode;
        }
        return rigidJoint_;
    }

    uint32_t skinJoints(int index)
    {
        uint32_t& first = firstJoints_[static_cast<size_t>(index)];
        if (first != kNoIndex)
            return first;
        const tinygltf::Skin& skin = at(file_.skins, index);
        first = addJoints(skin.joints.size());
        const auto matrices = skin.inverseBindMatrices < 0 ? std::vector<mat4>(skin.joints.size(), mat4{1})
                                                           : readAs<mat4>(file_, at(file_.accessors, skin.inverseBindMatrices));
        for (size_t i = 0; i < skin.joints.size(); ++i)
            model_.joints[first + i] = {at(placement_.nodes, skin.joints[i]), matrices[i]};
        return first;
    }

    uint32_t materialOf(const tinygltf::Primitive& primitive)
    {
        if (primitive.material >= 0)
            return static_cast<uint32_t>(primitive.material);
        // glTF's default: white, rough, metallic.
        if (model_.materials.size() == file_.materials.size())
            model_.materials.push_back({.albedo = vec3{1}, .metallic = 1});
        return static_cast<uint32_t>(file_.materials.size());
    }

    void appendInfluences(const TriangleList& list, uint32_t firstJoint, bool isSkinned)
    {
        for (size_t i = 0; i < list.positions.size(); ++i) {
            Influence influence = isSkinned ? list.influences[i] : Influence{};
            for (size_t j = 0; j < 4; ++j)
                influence.joints[j] = static_cast<uint16_t>(influence.joints[j] + firstJoint);
            model_.mesh.influences.push_back(influence);
        }
    }

    // A target of a mesh runs through all its primitives, with zeros for those it does not move.
    void appendMorphs(const TriangleList& list, size_t firstMorph)
    {
        for (size_t i = 0; i < list.morphPositions.size(); ++i) {
            MorphTarget& target = model_.mesh.morphTargets[firstMorph + i];
            const size_t before = model_.mesh.positions.size() - target.firstVertex;
            target.positions.resize(before);
            target.positions.insert(target.positions.end(), list.morphPositions[i].begin(), list.morphPositions[i].end());
            target.positions.resize(before + list.positions.size());
            if (target.normals.empty() && list.morphNormals[i].empty())
                continue;
            target.normals.resize(before);
            target.normals.insert(target.normals.end(), list.morphNormals[i].begin(), list.morphNormals[i].end());
            target.normals.resize(before + list.positions.size());
        }
    }

    void appendTriangles(const TriangleList& list, uint32_t material)
    {
        Mesh& mesh = model_.mesh;
        const auto firstVertex = static_cast<uint32_t>(mesh.positions.size());
        for (const uint32_t index : list.indices)
            mesh.indices.push_back(firstVertex + index);
        mesh.triangleMaterials.insert(mesh.triangleMaterials.end(), list.indices.size() / 3, material);
    }

    void appendStreams(const TriangleList& list)
    {
        Mesh& mesh = model_.mesh;
        if (!list.bakeUvs.empty() || !mesh.bakeUvs.empty()) {
            mesh.bakeUvs.resize(mesh.positions.size());
            mesh.bakeUvs.insert(mesh.bakeUvs.end(), list.bakeUvs.begin(), list.bakeUvs.end());
            mesh.bakeUvs.resize(mesh.positions.size() + list.positions.size());
        }
        mesh.positions.insert(mesh.positions.end(), list.positions.begin(), list.positions.end());
        mesh.normals.insert(mesh.normals.end(), list.normals.begin(), list.normals.end());
        mesh.uvs.insert(mesh.uvs.end(), list.uvs.begin(), list.uvs.end());
    }

    void addRestWeights(const tinygltf::Node& node, const tinygltf::Mesh& mesh)
    {
        const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
        for (const double weight : weights)
            model_.restMorphWeights.push_back(static_cast<float>(weight));
        model_.restMorphWeights.resize(model_.mesh.morphTargets.size());
    }

    Model& model_;
    Placement& placement_;
    const tinygltf::Model& file_;
    std::vector<mat4> nodeToModel_;
    std::vector<uint32_t> firstJoints_; // by skin
    uint32_t rigidJoint_ = kNoIndex;    // of the node in hand
};

} // namespace

void addMeshes(Model& model, Placement& placement, const tinygltf::Model& file)
{
    MeshMerge merge(model, placement, file);
    for (const int root : rootsOf(file))
        merge.addTree(root);
    if (model.joints.empty())
        model.joints.push_back({});
    orderTriangles(model.mesh, restMesh(model).positions);
}

} // namespace antumbra::scene
