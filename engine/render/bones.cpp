#include "render/bones.h"

#include "scene/principal_axis.h"
#include "scene/triangle_joints.h"

#include <algorithm>

namespace antumbra::render {

namespace {

/// Ends of the capsule's segment: along the axis, drawn in by the radius at both ends.
void fitAxis(shader::BoneBlock& bone, const std::vector<vec3>& points)
{
    vec3 centre{0};
    for (const vec3& point : points)
        centre += point / static_cast<float>(points.size());
    const vec3 axis = scene::principalAxis(points, centre);
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
    Bones bones;
    for (const auto& [joint, vertices] : scene::verticesByJoint(mesh)) {
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
