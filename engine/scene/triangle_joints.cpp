#include "scene/triangle_joints.h"

#include <algorithm>
#include <array>
#include <utility>

namespace antumbra::scene {

namespace {

uint32_t strongestJoint(const Mesh& mesh, size_t triangle)
{
    std::array<std::pair<uint32_t, float>, 12> shares{};
    size_t count = 0;
    for (size_t corner = 0; corner < 3; ++corner) {
        const Influence& influence = mesh.influences[mesh.indices[3 * triangle + corner]];
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

} // namespace

std::map<uint32_t, std::vector<uint32_t>> verticesByJoint(const Mesh& mesh)
{
    std::map<uint32_t, std::vector<uint32_t>> corners;
    for (size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
        std::vector<uint32_t>& mine = corners[strongestJoint(mesh, triangle)];
        mine.insert(mine.end(), mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * triangle),
                    mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * triangle + 3));
    }
    for (auto& [joint, vertices] : corners) {
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
    return corners;
}

} // namespace antumbra::scene
