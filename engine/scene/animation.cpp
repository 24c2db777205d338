#include "scene/animation.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>

namespace antumbra::scene {

namespace {

/// Where a time falls among a track's keys: between `first` and `second`, `share` of the way, `interval` seconds apart.
struct KeyInterval
{
    size_t first;
    size_t second;
    float share;
    float interval;
};

KeyInterval findInterval(std::span<const float> times, float seconds)
{
    const auto after = static_cast<size_t>(std::upper_bound(times.begin(), times.end(), seconds) - times.begin());
    if (after == 0)
        return {0, 0, 0, 0};
    if (after == times.size())
        return {after - 1, after - 1, 0, 0};
    const float interval = times[after] - times[after - 1];
    return {after - 1, after, interval > 0 ? (seconds - times[after - 1]) / interval : 0, interval};
}

// In double, so that no finite quaternion overflows; zero has no direction and reads as no rotation.
quat unitOf(quat rotation)
{
    const glm::dvec4 q{rotation.x, rotation.y, rotation.z, rotation.w};
    const double length = std::sqrt(glm::dot(q, q));
    if (!(length > 0) || !std::isfinite(length))
        return {1, 0, 0, 0};
    const glm::dvec4 unit = q / length;
    return {static_cast<float>(unit.w), static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)};
}

quat quatOf(const float* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

// Cubic spline of glTF 2.0, appendix C: b0 and b1 are the tangents, scaled by the interval.
float hermite(float v0, float b0, float v1, float b1, float t)
{
    const float t2 = t * t;
    const float t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * v0 + (t3 - 2 * t2 + t) * b0 + (-2 * t3 + 3 * t2) * v1 + (t3 - t2) * b1;
}

// One float of a Step, Linear or Cubic track.
float valueAt(const Track& track, const KeyInterval& keys, size_t component)
{
    const size_t width = track.width;
    if (track.interpolation == Interpolation::Cubic) {
        const float* first = &track.values[3 * width * keys.first + component];
        const float* second = &track.values[3 * width * keys.second + component];
        if (keys.first == keys.second)
            return first[width];
        return hermite(first[width], keys.interval * first[2 * width], second[width], keys.interval * second[0], keys.share);
    }
    const float first = track.values[width * keys.first + component];
    const float second = track.values[width * keys.second + component];
    return track.interpolation == Interpolation::Step ? first : first + keys.share * (second - first);
}

vec3 vectorAt(const Track& track, const KeyInterval& keys)
{
    return {valueAt(track, keys, 0), valueAt(track, keys, 1), valueAt(track, keys, 2)};
}

quat rotationAt(const Track& track, const KeyInterval& keys)
{
    if (track.interpolation != Interpolation::Linear)
        return unitOf({valueAt(track, keys, 3), valueAt(track, keys, 0), valueAt(track, keys, 1), valueAt(track, keys, 2)});
    const quat first = unitOf(quatOf(&track.values[4 * keys.first]));
    const quat second = unitOf(quatOf(&track.values[4 * keys.second]));
    return unitOf(glm::slerp(first, second, keys.share));
}

void apply(LocalPose& pose, const Track& track, const KeyInterval& keys)
{
    switch (track.channel) {
    case Channel::Translation: pose.nodes[track.target].translation = vectorAt(track, keys); break;
    case Channel::Rotation: pose.nodes[track.target].rotation = rotationAt(track, keys); break;
    case Channel::Scale: pose.nodes[track.target].scale = vectorAt(track, keys); break;
    case Channel::MorphWeights:
        for (uint32_t i = 0; i < track.width; ++i)
            pose.morphWeights[track.target + i] = valueAt(track, keys, i);
        break;
    }
}

mat4 matrixOf(const NodePose& pose)
{
    const mat3 rotation = glm::mat3_cast(unitOf(pose.rotation));
    return {vec4(rotation[0] * pose.scale.x, 0), vec4(rotation[1] * pose.scale.y, 0), vec4(rotation[2] * pose.scale.z, 0),
            vec4(pose.translation, 1)};
}

// Products of finite numbers can overflow; such a part is drawn as nothing, not as NaN.
mat4 finiteOrZero(const mat4& matrix)
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                return mat4{0};
    return matrix;
}

// Normals turn with the cofactors, which exist for singular matrices too; their sign keeps a mirrored surface facing outwards.
vec3 turnedNormal(const mat3& linear, vec3 normal)
{
    const mat3 cofactors{glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]), glm::cross(linear[0], linear[1])};
    const float sign = glm::dot(linear[0], cofactors[0]) < 0 ? -1.0f : 1.0f;
    const vec3 turned = sign * (cofactors * normal);
    const float length = glm::length(turned);
    return length > 0 && std::isfinite(length) ? turned / length : normal;
}

void addMorphs(Mesh& mesh, std::span<const float> morphWeights)
{
    for (size_t target = 0; target < mesh.morphTargets.size(); ++target) {
        const MorphTarget& morph = mesh.morphTargets[target];
        for (size_t i = 0; i < morph.positions.size(); ++i)
            mesh.positions[morph.firstVertex + i] += morphWeights[target] * morph.positions[i];
        for (size_t i = 0; i < morph.normals.size(); ++i)
            mesh.normals[morph.firstVertex + i] += morphWeights[target] * morph.normals[i];
    }
}

} // namespace

void setRest(LocalPose& pose, const Model& model)
{
    pose.nodes.resize(model.nodes.size());
    std::transform(model.nodes.begin(), model.nodes.end(), pose.nodes.begin(), [](const Node& node) { return node.rest; });
    pose.morphWeights = model.restMorphWeights;
}

void sample(LocalPose& pose, const Clip& clip, float seconds)
{
    for (const Track& track : clip.tracks)
        if (!track.times.empty())
            apply(pose, track, findInterval(track.times, seconds));
}

void blend(LocalPose& pose, const LocalPose& towards, float share)
{
    check(pose.nodes.size() == towards.nodes.size() && pose.morphWeights.size() == towards.morphWeights.size(), "two poses of one model");
    for (size_t i = 0; i < pose.nodes.size(); ++i) {
        NodePose& node = pose.nodes[i];
        const NodePose& goal = towards.nodes[i];
        node.translation = glm::mix(node.translation, goal.translation, share);
        node.rotation = unitOf(glm::slerp(unitOf(node.rotation), unitOf(goal.rotation), share));
        node.scale = glm::mix(node.scale, goal.scale, share);
    }
    for (size_t i = 0; i < pose.morphWeights.size(); ++i)
        pose.morphWeights[i] = glm::mix(pose.morphWeights[i], towards.morphWeights[i], share);
}

void resolve(std::span<mat4> jointMatrices, std::vector<mat4>& nodeToModel, const LocalPose& pose, const Model& model)
{
    check(jointMatrices.size() == model.joints.size(), "one matrix a joint");
    check(pose.nodes.size() == model.nodes.size(), "a pose of this model");
    nodeToModel.resize(model.nodes.size());
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const mat4 local = matrixOf(pose.nodes[i]);
        const uint32_t parent = model.nodes[i].parent;
        nodeToModel[i] = finiteOrZero(parent == kNoIndex ? local : nodeToModel[parent] * local);
    }
    for (size_t i = 0; i < model.joints.size(); ++i)
        jointMatrices[i] = finiteOrZero(nodeToModel[model.joints[i].node] * model.joints[i].inverseBind);
}

Mesh posedMesh(const Model& model, std::span<const mat4> jointMatrices, std::span<const float> morphWeights)
{
    check(morphWeights.size() == model.mesh.morphTargets.size(), "one weight a morph target");
    Mesh posed = model.mesh;
    addMorphs(posed, morphWeights);
    for (size_t i = 0; i < posed.positions.size(); ++i) {
        const Influence& influence = posed.influences[i];
        mat4 jointToModel{0};
        for (size_t j = 0; j < 4; ++j)
            if (influence.weights[j] > 0)
                jointToModel += influence.weights[j] * jointMatrices[influence.joints[j]];
        posed.positions[i] = vec3(jointToModel * vec4(posed.positions[i], 1));
        posed.normals[i] = turnedNormal(mat3(jointToModel), posed.normals[i]);
    }
    posed.morphTargets.clear();
    posed.influences.clear();
    return posed;
}

Mesh restMesh(const Model& model)
{
    LocalPose pose;
    setRest(pose, model);
    std::vector<mat4> jointMatrices(model.joints.size());
    std::vector<mat4> nodeToModel;
    resolve(jointMatrices, nodeToModel, pose, model);
    return posedMesh(model, jointMatrices, pose.morphWeights);
}

} // namespace antumbra::scene
