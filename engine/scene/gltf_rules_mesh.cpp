#include "scene/gltf_accessor.h"
#include "scene/gltf_rules.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace antumbra::scene {

namespace {

using Attributes = std::map<std::string, int>;

// Component formats as a set; the second of each pair is normalised.
enum Component : unsigned {
    kFloat = 1u << 0,
    kByte = 1u << 1,
    kByteN = 1u << 2,
    kUbyte = 1u << 3,
    kUbyteN = 1u << 4,
    kShort = 1u << 5,
    kShortN = 1u << 6,
    kUshort = 1u << 7,
    kUshortN = 1u << 8,
};
constexpr unsigned kAnySmall = kByte | kByteN | kUbyte | kUbyteN | kShort | kShortN | kUshort | kUshortN;
constexpr unsigned kSigned = kByteN | kShortN;
constexpr unsigned kFraction = kFloat | kUbyteN | kUshortN;

/// What the accessor of an attribute may hold; `quantized` adds to it under KHR_mesh_quantization.
struct AttributeFormat
{
    std::string_view semantic;
    bool isIndexed; // TEXCOORD_0, TEXCOORD_1, ...
    int widest;     // components
    int narrowest;
    unsigned components;
    unsigned quantized;
};
constexpr AttributeFormat kFormats[] = {
    {"POSITION", false, 3, 3, kFloat, kAnySmall},   {"NORMAL", false, 3, 3, kFloat, kSigned}, {"TANGENT", false, 4, 4, kFloat, kSigned},
    {"TEXCOORD", true, 2, 2, kFraction, kAnySmall}, {"COLOR", true, 4, 3, kFraction, 0},      {"JOINTS", true, 4, 4, kUbyte | kUshort, 0},
    {"WEIGHTS", true, 4, 4, kFraction, 0},
};

unsigned componentOf(const tinygltf::Accessor& accessor)
{
    const unsigned normalized = accessor.normalized ? 1 : 0;
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return kFloat;
    case TINYGLTF_COMPONENT_TYPE_BYTE: return kByte << normalized;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return kUbyte << normalized;
    case TINYGLTF_COMPONENT_TYPE_SHORT: return kShort << normalized;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return kUshort << normalized;
    default: return 0;
    }
}

const AttributeFormat* findFormat(std::string_view name)
{
    for (const AttributeFormat& format : kFormats) {
        if (!name.starts_with(format.semantic))
            continue;
        const std::string_view rest = name.substr(format.semantic.size());
        const bool isNumber = rest.size() >= 2 && rest.size() <= 4 && rest[0] == '_' && (rest[1] != '0' || rest.size() == 2) &&
                              std::all_of(rest.begin() + 1, rest.end(), [](char c) { return c >= '0' && c <= '9'; });
        if (format.isIndexed ? isNumber : rest.empty())
            return &format;
    }
    return nullptr;
}

/// One file's meshes; facts about an accessor that many primitives share are found once.
class MeshCheck
{
public:
    MeshCheck(const tinygltf::Model& file, Repairs& repairs)
        : file_(file), repairs_(repairs),
          isQuantized_(std::count(file.extensionsUsed.begin(), file.extensionsUsed.end(), "KHR_mesh_quantization") != 0)
    {
    }

    void all()
    {
        for (size_t i = 0; i < file_.meshes.size(); ++i)
            checkMesh(file_.meshes[i], fmt::format("meshes[{}]", i));
        for (size_t i = 0; i < file_.nodes.size(); ++i)
            checkInstance(file_.nodes[i], fmt::format("nodes[{}]", i));
    }

private:
    void checkMesh(const tinygltf::Mesh& mesh, const std::string& where)
    {
        const size_t targets = mesh.primitives.front().targets.size();
        require(mesh.weights.empty() || mesh.weights.size() == targets, "{}: {} weights for {} morph targets", where, mesh.weights.size(),
                targets);
        for (size_t i = 0; i < mesh.primitives.size(); ++i) {
            const std::string place = fmt::format("{}.primitives[{}]", where, i);
            require(mesh.primitives[i].targets.size() == targets, "{}: {} morph targets, the first primitive has {}", place,
                    mesh.primitives[i].targets.size(), targets);
            checkPrimitive(mesh.primitives[i], place);
        }
    }

    void checkPrimitive(const tinygltf::Primitive& primitive, const std::string& where)
    {
        const size_t vertices = at(file_.accessors, primitive.attributes.begin()->second).count;
        checkAttributes(primitive.attributes, vertices, 0, where);
        checkSets(primitive, where);
        checkWeights(primitive.attributes, vertices, where);
        checkPositionBounds(primitive, where);
        for (size_t i = 0; i < primitive.targets.size(); ++i) {
            const std::string place = fmt::format("{}.targets[{}]", where, i);
            for (const auto& [name, accessor] : primitive.targets[i])
                require(primitive.attributes.contains(name), "{}: the primitive has no {}", place, name);
            checkAttributes(primitive.targets[i], vertices, 1, place);
        }
        checkUnit(primitive.attributes, where);
        if (primitive.indices >= 0)
            checkIndices(primitive.indices, vertices, where);
    }

    // The tangents of morph targets have no sign: they are narrower.
    void checkAttributes(const Attributes& attributes, size_t vertices, int tangentsNarrower, const std::string& where)
    {
        for (const auto& [name, index] : attributes) {
            const tinygltf::Accessor& accessor = at(file_.accessors, index);
            require(accessor.count == vertices, "{}: {} has {} elements, other attributes {}", where, name, accessor.count, vertices);
            checkPacking(index, name, where);
            if (name.starts_with("_")) {
                require(accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, "{}: {} is of 32-bit integers", where, name);
                continue;
            }
            const AttributeFormat* format = findFormat(name);
            require(format != nullptr, "{}: \"{}\" is no attribute of glTF", where, name);
            const int narrower = name == "TANGENT" ? tangentsNarrower : 0;
            const int width = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
            const bool isVector = layoutOf(accessor).columns == 1;
            const unsigned allowed = format->components | (isQuantized_ ? format->quantized : 0);
            require(isVector && width >= format->narrowest - narrower && width <= format->widest - narrower &&
                        (componentOf(accessor) & allowed) != 0,
                    "{}: {} has a wrong type or component type", where, name);
        }
    }

    void checkPacking(int index, const std::string& name, const std::string& where)
    {
        const tinygltf::Accessor& accessor = at(file_.accessors, index);
        if (accessor.bufferView < 0)
            return;
        const tinygltf::BufferView& view = at(file_.bufferViews, accessor.bufferView);
        require((view.byteOffset + accessor.byteOffset) % 4 == 0 && strideOf(file_, accessor) % 4 == 0, "{}: {} is not aligned to 4 bytes",
                where, name);
        const int owner = ownerOfView_.try_emplace(accessor.bufferView, index).first->second;
        require(view.byteStride != 0 || owner == index, "{}: {} shares a buffer view that has no byteStride", where, name);
    }

    // TEXCOORD_1 needs TEXCOORD_0, and a material's texture the set it names; joints come with weights.
    void checkSets(const tinygltf::Primitive& primitive, const std::string& where) const
    {
        const Attributes& attributes = primitive.attributes;
        for (const auto& [name, accessor] : attributes) {
            const size_t digits = name.rfind('_') + 1;
            const AttributeFormat* format = findFormat(name);
            if (format == nullptr || !format->isIndexed)
                continue;
            const int set = std::stoi(name.substr(digits));
            require(set == 0 || attributes.contains(name.substr(0, digits) + std::to_string(set - 1)), "{}: {} without the set before it",
                    where, name);
        }
        for (const auto& [name, accessor] : attributes)
            if (name.starts_with("JOINTS_"))
                require(attributes.contains("WEIGHTS_" + name.substr(7)), "{}: {} without weights", where, name);
        if (primitive.material < 0)
            return;
        const tinygltf::Material& material = at(file_.materials, primitive.material);
        const auto checkSet = [&](const auto& texture) {
            require(texture.index < 0 || attributes.contains("TEXCOORD_" + std::to_string(texture.texCoord)),
                    "{}: its material needs TEXCOORD_{}", where, texture.texCoord);
        };
        checkSet(material.pbrMetallicRoughness.baseColorTexture);
        checkSet(material.pbrMetallicRoughness.metallicRoughnessTexture);
        checkSet(material.normalTexture);
        checkSet(material.occlusionTexture);
        checkSet(material.emissiveTexture);
    }

    // All sets of a vertex together are its shares; the model scales their sum to one.
    void checkWeights(const Attributes& attributes, size_t vertices, const std::string& where)
    {
        std::vector<float> sums(attributes.contains("JOINTS_0") ? vertices : 0);
        for (int set = 0; !sums.empty() && attributes.contains(fmt::format("JOINTS_{}", set)); ++set) {
            const tinygltf::Accessor& accessor = at(file_.accessors, attributes.at(fmt::format("WEIGHTS_{}", set)));
            if (!hasData(file_, accessor))
                return;
            const std::vector<float> weights = readFloats(file_, accessor);
            if (std::ranges::any_of(weights, [](float weight) { return weight < 0; }))
                repairs_.note(where, "negative weights count as none");
            for (size_t i = 0; i < weights.size(); ++i)
                sums[i / 4] += std::max(weights[i], 0.0f);
        }
        if (std::ranges::count(sums, 0.0f) != 0)
            repairs_.note(where, "vertices without weights follow the first joint of their skin");
    }

    void checkPositionBounds(const tinygltf::Primitive& primitive, const std::string& where) const
    {
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end())
            return;
        const tinygltf::Accessor& accessor = at(file_.accessors, position->second);
        require(accessor.minValues.size() == 3 && accessor.maxValues.size() == 3, "{}: POSITION has no min and max", where);
    }

    void checkUnit(const Attributes& attributes, const std::string& where)
    {
        for (const auto& [name, index] : attributes) {
            const bool isTangent = name == "TANGENT";
            const tinygltf::Accessor& accessor = at(file_.accessors, index);
            if ((name != "NORMAL" && !isTangent) || !hasData(file_, accessor) || !isUnitChecked_.insert(index).second)
                continue;
            const std::vector<float> values = readFloats(file_, accessor);
            require(areUnit(values, isTangent ? 4 : 3, 3), "{}: {} has vectors that are not of unit length", where, name);
            for (size_t i = 3; isTangent && i < values.size(); i += 4)
                require(std::abs(values[i]) == 1, "{}: TANGENT has a sign that is neither 1 nor -1", where);
        }
    }

    void checkIndices(int index, size_t vertices, const std::string& where)
    {
        const tinygltf::Accessor& indices = at(file_.accessors, index);
        const bool isUnsigned = indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        require(indices.type == TINYGLTF_TYPE_SCALAR && isUnsigned && !indices.normalized, "{}: indices must be unsigned integers", where);
        require(at(file_.bufferViews, indices.bufferView).byteStride == 0, "{}: indices have a byteStride", where);
        require(greatestOf(index) < vertices, "{}: index {} of {} vertices", where, greatestOf(index), vertices);
    }

    void checkInstance(const tinygltf::Node& node, const std::string& where)
    {
        if (node.mesh < 0)
            return;
        const tinygltf::Mesh& mesh = at(file_.meshes, node.mesh);
        require(node.weights.empty() || node.weights.size() == mesh.primitives.front().targets.size(),
                "{}: as many weights as its mesh has morph targets were expected", where);
        if (node.skin < 0)
            return;
        const size_t joints = at(file_.skins, node.skin).joints.size();
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            for (const auto& [name, index] : primitive.attributes)
                if (name.starts_with("JOINTS_"))
                    require(greatestOf(index) < joints, "{}: {} names joint {}, its skin has {}", where, name, greatestOf(index), joints);
    }

    uint32_t greatestOf(int index)
    {
        const auto [entry, isNew] = greatest_.try_emplace(index, 0);
        if (isNew) {
            const std::vector<uint32_t> values = readIntegers(file_, at(file_.accessors, index));
            entry->second = *std::max_element(values.begin(), values.end());
        }
        return entry->second;
    }

    const tinygltf::Model& file_;
    Repairs& repairs_;
    bool isQuantized_;
    std::map<int, int> ownerOfView_;
    std::map<int, uint32_t> greatest_;
    std::set<int> isUnitChecked_;
};

} // namespace

void checkMeshes(const tinygltf::Model& file, Repairs& repairs) { MeshCheck(file, repairs).all(); }

} // namespace antumbra::scene
