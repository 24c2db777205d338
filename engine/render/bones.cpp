#include "render/bones.h"

#include <algorithm>
#include <array>
#include <map>

namespace antumbra::render {

namespace {

/// The joint with the greatest share in a triangle's corners.
uint32_t strongestJoint(const scene::Mesh& mesh, size_t triangle)
{
    std::array<std::pair<uint32_t, float>, 12> shares{};
    size_t count = 0;
    for (size_t corner = 0; corner < 3; ++corner) {
        const scene::Influence& influence = mesh.influences[mesh.indices[3 * triangle + corner]];
        for (size_t k = 0; k < 4; ++k) {
            const auto end = shares.begin() + static_cast<std::ptrdiff_t>(count);
            const auto known = std::find_if(shares.begin(), end, [&](const auto& share) { return share.first == influence.joints[k]; });
            if (known != end)
                known->second += influence.weights[k];
            else
                shares.at(count++) = {influence.joints[k], influence.weights[k]};
        }
    }
    return std::max_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(count),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

/// The direction of greatest spread, by power iteration on the covariance.
vec3 principalAxis(const std::vector<vec3>& points, vec3 centre)
{
    mat3 covariance{0};
    for (const vec3& point : points)
        covariance += glm::outerProduct(point - centre, point - centre);
    vec3 axis{0.577f, 0.577f, 0.577f};
    for (int i = 0; i < 32; ++i) {
        const vec3 next = covariance * axis;
        const float length = glm::length(next);
        if (length < 1e-12f)
            break;
        axis = next / length;
    }
    return axis;
}

/// Ends of the capsule's segment: along the axis, drawn in by the radius at both ends.
void fitAxis(shader::BoneBlock& bone, const std::vector<vec3>& points)
{
    vec3 centre{0};
    for (const vec3& point : points)
        centre += point / static_cast<float>(points.size());
    const vec3 axis = principalAxis(points, centre);
    float lowest = 0, highest = 0, radius = 0;
    for (const vec3& point : points) {
        const float along = glm::dot(point - centre, axis);
        lowest = std::min(lowest, along);
        highest = std::max(highest, along);
        radius = std::max(radius, glm::length(point - centre - along * axis));
    }
    const float middle = 0.5f * (lowest + highest);
    bone.a = centre + axis * std::min(lowest + radius, middle);
    bone.b = centre + axis * std::max(highest - radius, middle);
}

} // namespace

Bones bonesOf(const scene::Model& model)
{
    const scene::Mesh& mesh = model.mesh;
    std::map<uint32_t, std::vector<uint32_t>> corners;
    for (size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
        std::vector<uint32_t>& mine = corners[strongestJoint(mesh, triangle)];
        mine.insert(mine.end(), mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * triangle),
                    mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * triangle + 3));
    }
    Bones bones;
    for (auto& [joint, vertices] : corners) {
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        std::vector<vec3> points;
        for (const uint32_t vertex : vertices)
            points.push_back(mesh.positions[vertex]);
        shader::BoneBlock bone{};
        bone.firstVertex = static_cast<uint32_t>(bones.vertices.size());
        bone.vertexCount = static_cast<uint32_t>(vertices.size());
        bone.joint = joint;
        fitAxis(bone, points);
        bones.blocks.push_back(bone);
        bones.vertices.insert(bones.vertices.end(), vertices.begin(), vertices.end());
    }
    return bones;
}

} // namespace antumbra::render
