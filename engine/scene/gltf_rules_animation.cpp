#include "scene/gltf_accessor.h"
#include "scene/gltf_rules.h"

#include <algorithm>
#include <set>
#include <utility>

namespace antumbra::scene {

namespace {

size_t morphTargetsOf(const tinygltf::Model& file, int node)
{
    const int mesh = at(file.nodes, node).mesh;
    return mesh < 0 ? 0 : at(file.meshes, mesh).primitives.front().targets.size();
}

void checkTimes(const tinygltf::Model& file, const tinygltf::Accessor& input, const std::string& where, Repairs& repairs)
{
    require(input.type == TINYGLTF_TYPE_SCALAR && input.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT, "{}: key times must be floats",
            where);
    if (!hasData(file, input))
        return;
    const std::vector<float> times = readFloats(file, input);
    require(times.front() >= 0, "{}: key times begin before zero", where);
    require(std::ranges::is_sorted(times), "{}: key times decrease", where);
    if (std::ranges::adjacent_find(times) != times.end())
        repairs.note(where, "of keys at the same time the last one holds");
}

bool isTightlyPacked(const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    return accessor.bufferView < 0 || at(file.bufferViews, accessor.bufferView).byteStride == 0;
}

void checkRotations(const tinygltf::Model& file, const tinygltf::Accessor& output, bool isCubic, const std::string& where)
{
    if (!hasData(file, output))
        return;
    const std::vector<float> values = readFloats(file, output);
    // Of in-tangent, value and out-tangent, the value is a rotation.
    const size_t step = isCubic ? 12 : 4;
    for (size_t i = isCubic ? 4 : 0; i + 4 <= values.size(); i += step)
        require(areUnit(std::span(values).subspan(i, 4), 4, 4), "{}: rotation of key {} is not a unit quaternion", where, i / step);
}

void checkChannel(const tinygltf::Model& file, const tinygltf::AnimationChannel& channel, const tinygltf::AnimationSampler& sampler,
                  const std::string& where)
{
    const tinygltf::Accessor& input = at(file.accessors, sampler.input);
    const tinygltf::Accessor& output = at(file.accessors, sampler.output);
    const bool isFloat = output.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool isCubic = sampler.interpolation == "CUBICSPLINE";
    size_t valuesPerKey = isCubic ? 3 : 1;
    if (channel.target_path == "translation" || channel.target_path == "scale") {
        require(output.type == TINYGLTF_TYPE_VEC3 && isFloat, "{}: a {} must be three floats", where, channel.target_path);
    } else if (channel.target_path == "rotation") {
        require(output.type == TINYGLTF_TYPE_VEC4 && (isFloat || output.normalized), "{}: a rotation must be four floats", where);
        checkRotations(file, output, isCubic, where);
    } else if (channel.target_path == "weights") {
        require(output.type == TINYGLTF_TYPE_SCALAR && (isFloat || output.normalized), "{}: weights must be floats", where);
        valuesPerKey *= morphTargetsOf(file, channel.target_node);
        require(valuesPerKey != 0, "{}: moves weights of a mesh without morph targets", where);
    } else {
        return; // a path of some extension: no track is made of it
    }
    require(output.count == input.count * valuesPerKey, "{}: {} values for {} keys", where, output.count, input.count);
}

} // namespace

void checkAnimations(const tinygltf::Model& file, Repairs& repairs)
{
    for (size_t i = 0; i < file.animations.size(); ++i) {
        const tinygltf::Animation& animation = file.animations[i];
        for (size_t j = 0; j < animation.samplers.size(); ++j) {
            const std::string where = fmt::format("animations[{}].samplers[{}]", i, j);
            const tinygltf::Accessor& input = at(file.accessors, animation.samplers[j].input);
            const tinygltf::Accessor& output = at(file.accessors, animation.samplers[j].output);
            require(isTightlyPacked(file, input) && isTightlyPacked(file, output), "{}: buffer views of keys have no byteStride", where);
            checkTimes(file, input, where, repairs);
        }
        std::set<std::pair<int, std::string>> targets;
        for (size_t j = 0; j < animation.channels.size(); ++j) {
            const tinygltf::AnimationChannel& channel = animation.channels[j];
            const std::string where = fmt::format("animations[{}].channels[{}]", i, j);
            require(static_cast<size_t>(channel.sampler) < animation.samplers.size(), "{}: there is no sampler {}", where, channel.sampler);
            require(targets.emplace(channel.target_node, channel.target_path).second, "{}: another channel has the same target", where);
            checkChannel(file, channel, at(animation.samplers, channel.sampler), where);
        }
    }
}

} // namespace antumbra::scene
