#include "scene/gltf_build.h"

#include "base/log.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_rules.h"

#include <algorithm>
#include <optional>

namespace antumbra::scene {

namespace {

Interpolation interpolationOf(const std::string& name)
{
    if (name == "STEP")
        return Interpolation::Step;
    return name == "CUBICSPLINE" ? Interpolation::Cubic : Interpolation::Linear;
}

Track trackOf(Channel channel, uint32_t target, size_t width)
{
    Track track;
    track.channel = channel;
    track.target = target;
    track.width = static_cast<uint32_t>(width);
    return track;
}

// Nothing for what moves no part of the model: another scene's weights, the paths of extensions.
std::optional<Track> aim(const tinygltf::AnimationChannel& channel, const Placement& placement, const tinygltf::Model& file)
{
    const uint32_t node = at(placement.nodes, channel.target_node);
    if (channel.target_path == "translation")
        return trackOf(Channel::Translation, node, 3);
    if (channel.target_path == "rotation")
        return trackOf(Channel::Rotation, node, 4);
    if (channel.target_path == "scale")
        return trackOf(Channel::Scale, node, 3);
    const uint32_t firstMorph = at(placement.firstMorphs, channel.target_node);
    if (channel.target_path != "weights" || firstMorph == kNoIndex)
        return std::nullopt;
    const tinygltf::Mesh& mesh = at(file.meshes, at(file.nodes, channel.target_node).mesh);
    return trackOf(Channel::MorphWeights, firstMorph, mesh.primitives.front().targets.size());
}

} // namespace

void addClips(Model& model, const Placement& placement, const tinygltf::Model& file)
{
    for (size_t i = 0; i < file.animations.size(); ++i) {
        const tinygltf::Animation& animation = file.animations[i];
        Clip clip;
        clip.name = animation.name.empty() ? fmt::format("clip {}", i) : animation.name;
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            std::optional<Track> track = aim(channel, placement, file);
            if (!track) {
                logWarning("animation \"{}\": the channel for \"{}\" moves nothing here", clip.name, channel.target_path);
                continue;
            }
            const tinygltf::AnimationSampler& sampler = at(animation.samplers, channel.sampler);
            track->interpolation = interpolationOf(sampler.interpolation);
            track->times = readFloats(file, at(file.accessors, sampler.input));
            track->values = readFloats(file, at(file.accessors, sampler.output));
            clip.duration = std::max(clip.duration, track->times.back());
            clip.tracks.push_back(std::move(*track));
        }
        model.clips.push_back(std::move(clip));
    }
}

} // namespace antumbra::scene
