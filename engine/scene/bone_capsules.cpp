#include "scene/bone_capsules.h"

#include "scene/principal_axis.h"
#include "scene/triangle_joints.h"

#include <algorithm>

namespace antumbra::scene {

namespace {

constexpr int kRounds = 200; // the ends of the walker's bones move by less than 0.1 mm in the last one

/// A third of the triangles around each vertex.
std::vector<float> vertexAreas(const Mesh& mesh)
{
    std::vector<float> areas(mesh.positions.size(), 0.0f);
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const uint32_t* const corners = &mesh.indices[i];
        const vec3 a = mesh.positions[corners[0]];
        const float doubled = glm::length(glm::cross(mesh.positions[corners[1]] - a, mesh.positions[corners[2]] - a));
        for (int corner = 0; corner < 3; ++corner)
            areas[corners[corner]] += doubled / 6;
    }
    return areas;
}

/// What is fitted to: points, and how much of the surface is at each.
struct Surface
{
    std::vector<vec3> points;
    std::vector<float> areas;
    float area = 0; // of all, > 0
};

/// Along the principal axis, with the mean distance from it for a radius.
BoneCapsule firstGuess(const Surface& surface)
{
    vec3 centre{0};
    for (size_t i = 0; i < surface.points.size(); ++i)
        centre += surface.points[i] * (surface.areas[i] / surface.area);
    const vec3 axis = principalAxis(surface.points, centre);
    float lowest = 0, highest = 0, radius = 0;
    for (size_t i = 0; i < surface.points.size(); ++i) {
        const vec3 from = surface.points[i] - centre;
        const float along = glm::dot(from, axis);
        lowest = std::min(lowest, along);
        highest = std::max(highest, along);
        radius += glm::length(from - along * axis) * (surface.areas[i] / surface.area);
    }
    const float middle = 0.5f * (lowest + highest);
    return {
        .a = centre + axis * std::min(lowest + radius, middle), .b = centre + axis * std::max(highest - radius, middle), .radius = radius};
}

/// Every point pulls what is nearest to it on the segment by as much as it lies off the capsule; the ends follow.
void improve(BoneCapsule& capsule, const Surface& surface)
{
    const vec3 along = capsule.b - capsule.a;
    vec3 pullA{0}, pullB{0};
    float shareA = 0, shareB = 0, mean = 0;
    for (size_t i = 0; i < surface.points.size(); ++i) {
        const vec3 from = surface.points[i] - capsule.a;
        const float at = std::clamp(glm::dot(from, along) / std::max(glm::dot(along, along), 1e-20f), 0.0f, 1.0f);
        const vec3 away = from - at * along;
        const float distance = glm::length(away), area = surface.areas[i] / surface.area;
        const vec3 pull = distance > 0 ? away * ((distance - capsule.radius) / distance) : vec3(0);
        pullA += (1 - at) * area * pull;
        pullB += at * area * pull;
        shareA += (1 - at) * area;
        shareB += at * area;
        mean += area * distance;
    }
    capsule.a += pullA / std::max(shareA, 1e-6f);
    capsule.b += pullB / std::max(shareB, 1e-6f);
    capsule.radius = mean;
}

} // namespace

std::vector<BoneCapsule> boneCapsules(const Model& model)
{
    const Mesh& mesh = model.mesh;
    const std::vector<float> areas = vertexAreas(mesh);
    std::vector<BoneCapsule> capsules;
    for (const auto& [joint, vertices] : verticesByJoint(mesh)) {
        Surface surface;
        for (const uint32_t vertex : vertices) {
            surface.points.push_back(mesh.positions[vertex]);
            surface.areas.push_back(areas[vertex]);
            surface.area += areas[vertex];
        }
        if (!(surface.area > 0))
            continue;
        BoneCapsule capsule = firstGuess(surface);
        for (int round = 0; round < kRounds; ++round)
            improve(capsule, surface);
        capsule.joint = joint;
        capsules.push_back(capsule);
    }
    return capsules;
}

} // namespace antumbra::scene
