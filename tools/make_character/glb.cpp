#include "tools/make_character/glb.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace antumbra::character {

namespace {

using Json = nlohmann::ordered_json;

enum ComponentType { kUint8 = 5121, kUint16 = 5123, kFloat = 5126 };
enum Target { kNoTarget = 0, kVertices = 34962, kIndices = 34963 };

void padTo4(std::vector<std::byte>& bytes, char filling)
{
    while (bytes.size() % 4 != 0)
        bytes.push_back(std::byte(filling));
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value)
{
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(T));
}

class Writer
{
public:
    explicit Writer(const scene::Model& model) : model_(model) {}

    std::vector<std::byte> write()
    {
        json_["asset"] = {{"version", "2.0"}, {"generator", "make_character"}};
        json_["scene"] = 0;
        json_["scenes"] = Json::array({{{"nodes", {0, model_.nodes.size()}}}});
        writeNodes();
        writeSkin();
        writeMaterials();
        writeMesh();
        for (const scene::Clip& clip : model_.clips)
            writeClip(clip);
        padTo4(binary_, 0);
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        return container();
    }

private:
    /// Returns the accessor's index.
    template <class T>
    size_t accessor(std::span<const T> values, ComponentType component, const char* type, Target target = kNoTarget)
    {
        padTo4(binary_, 0);
        Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size_bytes()}};
        if (target != kNoTarget)
            view["target"] = int{target};
        const auto bytes = std::as_bytes(values);
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        json_["bufferViews"].push_back(view);
        json_["accessors"].push_back(
            {{"bufferView", json_["bufferViews"].size() - 1}, {"componentType", int{component}}, {"count", values.size()}, {"type", type}});
        return json_["accessors"].size() - 1;
    }

    void writeNodes()
    {
        for (const scene::Node& node : model_.nodes) {
            const vec3 t = node.rest.translation;
            json_["nodes"].push_back({{"name", node.name}, {"translation", {t.x, t.y, t.z}}});
        }
        for (size_t i = 0; i < model_.nodes.size(); ++i)
            if (const uint32_t parent = model_.nodes[i].parent; parent != scene::kNoIndex)
                json_["nodes"][parent]["children"].push_back(i);
        json_["nodes"].push_back({{"name", model_.name}, {"mesh", 0}, {"skin", 0}});
    }

    void writeSkin()
    {
        std::vector<mat4> inverseBinds;
        Json joints = Json::array();
        for (const scene::Joint& joint : model_.joints) {
            inverseBinds.push_back(joint.inverseBind);
            joints.push_back(joint.node);
        }
        const size_t matrices = accessor(std::span<const mat4>(inverseBinds), kFloat, "MAT4");
        json_["skins"] = Json::array({{{"inverseBindMatrices", matrices}, {"skeleton", 0}, {"joints", joints}}});
    }

    void writeMaterials()
    {
        for (const scene::Material& material : model_.materials) {
            const vec3 c = material.albedo;
            json_["materials"].push_back({{"pbrMetallicRoughness",
                                           {{"baseColorFactor", {c.x, c.y, c.z, 1}},
                                            {"metallicFactor", material.metallic},
                                            {"roughnessFactor", material.roughness}}}});
        }
    }

    void writeMesh()
    {
        Json primitives = Json::array();
        for (uint32_t material = 0; material < model_.materials.size(); ++material)
            primitives.push_back(primitiveOf(material));
        json_["meshes"] = Json::array({{{"name", model_.name}, {"primitives", primitives}}});
    }

    /// The triangles of one material, with streams of their own.
    Json primitiveOf(uint32_t material)
    {
        const scene::Mesh& mesh = model_.mesh;
        std::vector<uint32_t> numbers(mesh.positions.size(), scene::kNoIndex);
        std::vector<vec3> positions, normals;
        std::vector<std::array<uint8_t, 4>> joints;
        std::vector<std::array<float, 4>> weights;
        std::vector<uint16_t> indices;
        Aabb box;
        for (size_t i = 0; i < mesh.indices.size(); ++i) {
            if (mesh.triangleMaterials[i / 3] != material)
                continue;
            const uint32_t vertex = mesh.indices[i];
            if (numbers[vertex] == scene::kNoIndex) {
                numbers[vertex] = static_cast<uint32_t>(positions.size());
                positions.push_back(mesh.positions[vertex]);
                normals.push_back(mesh.normals[vertex]);
                box.add(positions.back());
                weights.push_back(mesh.influences[vertex].weights);
                std::ranges::transform(mesh.influences[vertex].joints, joints.emplace_back().begin(),
                                       [](uint16_t joint) { return static_cast<uint8_t>(joint); });
            }
            indices.push_back(static_cast<uint16_t>(numbers[vertex]));
        }

        const size_t position = accessor(std::span<const vec3>(positions), kFloat, "VEC3", kVertices);
        json_["accessors"][position]["min"] = {box.lowest.x, box.lowest.y, box.lowest.z};
        json_["accessors"][position]["max"] = {box.highest.x, box.highest.y, box.highest.z};
        const Json attributes{{"POSITION", position},
                              {"NORMAL", accessor(std::span<const vec3>(normals), kFloat, "VEC3", kVertices)},
                              {"JOINTS_0", accessor(std::span<const std::array<uint8_t, 4>>(joints), kUint8, "VEC4", kVertices)},
                              {"WEIGHTS_0", accessor(std::span<const std::array<float, 4>>(weights), kFloat, "VEC4", kVertices)}};
        return {{"attributes", attributes},
                {"indices", accessor(std::span<const uint16_t>(indices), kUint16, "SCALAR", kIndices)},
                {"material", material}};
    }

    void writeClip(const scene::Clip& clip)
    {
        const std::vector<float>& times = clip.tracks.front().times; // shared by all tracks
        const size_t input = accessor(std::span<const float>(times), kFloat, "SCALAR");
        json_["accessors"][input]["min"] = Json::array({times.front()});
        json_["accessors"][input]["max"] = Json::array({times.back()});
        Json samplers = Json::array(), channels = Json::array();
        for (const scene::Track& track : clip.tracks) {
            const bool isRotation = track.channel == scene::Channel::Rotation;
            const size_t output = accessor(std::span<const float>(track.values), kFloat, isRotation ? "VEC4" : "VEC3");
            json_["accessors"][output]["count"] = times.size();
            channels.push_back(
                {{"sampler", samplers.size()}, {"target", {{"node", track.target}, {"path", isRotation ? "rotation" : "translation"}}}});
            samplers.push_back({{"input", input}, {"output", output}});
        }
        json_["animations"].push_back({{"name", clip.name}, {"samplers", samplers}, {"channels", channels}});
    }

    [[nodiscard]] std::vector<std::byte> container() const
    {
        constexpr uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
        const std::string text = json_.dump();
        const auto characters = std::as_bytes(std::span(text));
        std::vector<std::byte> chunk(characters.begin(), characters.end());
        padTo4(chunk, ' ');

        std::vector<std::byte> file;
        for (const uint32_t word : {kMagic, kVersion, static_cast<uint32_t>(12 + 8 + chunk.size() + 8 + binary_.size())})
            append(file, word);
        append(file, static_cast<uint32_t>(chunk.size()));
        append(file, kJsonChunk);
        file.insert(file.end(), chunk.begin(), chunk.end());
        append(file, static_cast<uint32_t>(binary_.size()));
        append(file, kBinaryChunk);
        file.insert(file.end(), binary_.begin(), binary_.end());
        return file;
    }

    const scene::Model& model_;
    Json json_;
    std::vector<std::byte> binary_;
};

} // namespace

std::vector<std::byte> toGlb(const scene::Model& model) { return Writer(model).write(); }

} // namespace antumbra::character
