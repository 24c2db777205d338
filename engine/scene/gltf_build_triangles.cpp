#include "scene/gltf_build.h"

#include "scene/gltf_accessor.h"
#include "scene/gltf_rules.h"

#include <algorithm>
#include <numeric>

namespace antumbra::scene {

namespace {

constexpr vec3 kUp{0, 1, 0};

vec3 unitOr(vec3 vector, vec3 fallback)
{
    const float length = glm::length(vector);
    return length > 0 && std::isfinite(length) ? vector / length : fallback;
}

std::vector<uint32_t> toTriangles(std::span<const uint32_t> run, int mode)
{
    std::vector<uint32_t> triangles;
    const size_t count = mode == TINYGLTF_MODE_TRIANGLES ? run.size() / 3 : run.size() - std::min<size_t>(run.size(), 2);
    for (size_t i = 0; i < count; ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLES)
            triangles.insert(triangles.end(), {run[3 * i], run[3 * i + 1], run[3 * i + 2]});
        else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            triangles.insert(triangles.end(), {run[i], run[i + 1 + i % 2], run[i + 2 - i % 2]});
        else
            triangles.insert(triangles.end(), {run[i + 1], run[i + 2], run[0]});
    }
    return triangles;
}

/// Reads the streams of one primitive; what the file does not have reads empty.
class Streams
{
public:
    Streams(const tinygltf::Model& file, const tinygltf::Primitive& primitive) : file_(file), primitive_(primitive) {}

    template <class T>
    std::vector<T> read(const std::map<std::string, int>& attributes, const std::string& name) const
    {
        const auto found = attributes.find(name);
        return found == attributes.end() ? std::vector<T>{} : readAs<T>(file_, at(file_.accessors, found->second));
    }

    template <class T>
    std::vector<T> read(const std::string& name) const
    {
        return read<T>(primitive_.attributes, name);
    }

    std::vector<uint32_t> indices(size_t vertices) const
    {
        if (primitive_.indices >= 0)
            return readIntegers(file_, at(file_.accessors, primitive_.indices));
        std::vector<uint32_t> indices(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }

    // The engine samples both textures at one pair of coordinates: the base colour's.
    std::vector<vec2> surfaceUvs() const
    {
        if (primitive_.material < 0)
            return read<vec2>("TEXCOORD_0");
        const tinygltf::TextureInfo& texture = at(file_.materials, primitive_.material).pbrMetallicRoughness.baseColorTexture;
        const auto extension = texture.extensions.find("KHR_texture_transform");
        if (extension == texture.extensions.end())
            return read<vec2>("TEXCOORD_" + std::to_string(texture.texCoord));
        return transformedUvs(extension->second, texture.texCoord);
    }

    std::vector<Influence> influences(size_t vertices) const
    {
        std::vector<std::vector<uint32_t>> joints;
        std::vector<std::vector<vec4>> weights;
        for (int set = 0; primitive_.attributes.contains(fmt::format("JOINTS_{}", set)); ++set) {
            joints.push_back(readIntegers(file_, at(file_.accessors, primitive_.attributes.at(fmt::format("JOINTS_{}", set)))));
            weights.push_back(read<vec4>(fmt::format("WEIGHTS_{}", set)));
        }
        std::vector<Influence> influences(joints.empty() ? 0 : vertices);
        for (size_t i = 0; i < influences.size(); ++i)
            influences[i] = strongest(joints, weights, i);
        return influences;
    }

private:
    std::vector<vec2> transformedUvs(const tinygltf::Value& transform, int texCoord) const
    {
        const auto number = [](const tinygltf::Value& value) { return static_cast<float>(value.GetNumberAsDouble()); };
        const auto pair = [&](const char* name, vec2 fallback) {
            return transform.Has(name) ? vec2(number(transform.Get(name).Get(0)), number(transform.Get(name).Get(1))) : fallback;
        };
        const int set = transform.Has("texCoord") ? transform.Get("texCoord").GetNumberAsInt() : texCoord;
        const vec2 offset = pair("offset", vec2{0});
        const vec2 scale = pair("scale", vec2{1});
        const float angle = transform.Has("rotation") ? number(transform.Get("rotation")) : 0;
        std::vector<vec2> uvs = read<vec2>("TEXCOORD_" + std::to_string(set));
        for (vec2& uv : uvs) {
            const vec2 scaled = uv * scale;
            uv = offset +
                 vec2{std::cos(angle) * scaled.x + std::sin(angle) * scaled.y, std::cos(angle) * scaled.y - std::sin(angle) * scaled.x};
        }
        return uvs;
    }

    // The four greatest weights of all sets, their sum made one; a vertex without any hangs on the first joint.
    static Influence strongest(const std::vector<std::vector<uint32_t>>& joints, const std::vector<std::vector<vec4>>& weights,
                               size_t vertex)
    {
        struct Share
        {
            float weight;
            uint32_t joint;
        };
        std::vector<Share> shares;
        for (size_t set = 0; set < joints.size(); ++set)
            for (int i = 0; i < 4; ++i)
                shares.push_back({std::max(weights[set][vertex][i], 0.0f), joints[set][4 * vertex + static_cast<size_t>(i)]});
        std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.weight > b.weight; });
        const double sum = double{shares[0].weight} + shares[1].weight + shares[2].weight + shares[3].weight;
        Influence influence;
        for (size_t i = 0; i < 4 && sum > 0; ++i) {
            influence.weights[i] = static_cast<float>(shares[i].weight / sum);
            influence.joints[i] = static_cast<uint16_t>(influence.weights[i] > 0 ? shares[i].joint : 0);
        }
        return influence;
    }

    const tinygltf::Model& file_;
    const tinygltf::Primitive& primitive_;
};

template <class T>
void unweld(std::vector<T>& stream, const std::vector<uint32_t>& indices)
{
    if (stream.empty())
        return;
    std::vector<T> unwelded(indices.size());
    std::transform(indices.begin(), indices.end(), unwelded.begin(), [&](uint32_t index) { return stream[index]; });
    stream = std::move(unwelded);
}

// glTF asks for flat normals where a file has none, so every triangle gets vertices of its own.
void makeFlat(TriangleList& list)
{
    unweld(list.positions, list.indices);
    unweld(list.uvs, list.indices);
    unweld(list.bakeUvs, list.indices);
    unweld(list.influences, list.indices);
    for (size_t i = 0; i < list.morphPositions.size(); ++i) {
        unweld(list.morphPositions[i], list.indices);
        unweld(list.morphNormals[i], list.indices);
    }
    list.normals.resize(list.positions.size());
    for (size_t i = 0; i + 2 < list.positions.size(); i += 3) {
        const vec3* corner = &list.positions[i];
        std::fill_n(&list.normals[i], 3, unitOr(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), kUp));
    }
    std::iota(list.indices.begin(), list.indices.end(), 0u);
}

} // namespace

TriangleList readTriangles(const tinygltf::Model& file, const tinygltf::Primitive& primitive)
{
    TriangleList list;
    const Streams streams(file, primitive);
    list.positions = streams.read<vec3>("POSITION");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || list.positions.empty())
        return {};
    list.normals = streams.read<vec3>("NORMAL");
    for (vec3& normal : list.normals)
        normal = unitOr(normal, kUp);
    list.uvs = streams.surfaceUvs();
    list.bakeUvs = streams.read<vec2>("TEXCOORD_1");
    list.influences = streams.influences(list.positions.size());
    list.indices = toTriangles(streams.indices(list.positions.size()), primitive.mode);
    for (const auto& target : primitive.targets) {
        list.morphPositions.push_back(streams.read<vec3>(target, "POSITION"));
        list.morphNormals.push_back(streams.read<vec3>(target, "NORMAL"));
    }
    if (list.normals.empty())
        makeFlat(list);
    list.uvs.resize(list.positions.size());
    return list;
}

} // namespace antumbra::scene
