#include "tools/make_character/surface.h"

namespace antumbra::character {

std::vector<std::array<double, kJointCount>> skinWeights(const Surface& surface)
{
    constexpr int kSteps = 6;
    using Weights = std::array<double, kJointCount>;

    std::vector<Weights> weights(surface.positions.size(), Weights{});
    for (size_t vertex = 0; vertex < weights.size(); ++vertex)
        weights[vertex][limbAt(surface.positions[vertex])] = 1;

    // Each vertex moves half-way to the mean of its neighbours; in a closed mesh every neighbour follows it in one triangle.
    for (int step = 0; step < kSteps; ++step) {
        std::vector<Weights> sums(weights.size(), Weights{});
        std::vector<double> neighbourCounts(weights.size());
        for (const glm::uvec3& triangle : surface.triangles)
            for (int corner = 0; corner < 3; ++corner) {
                const uint32_t vertex = triangle[corner], next = triangle[(corner + 1) % 3];
                ++neighbourCounts[vertex];
                for (size_t joint = 0; joint < kJointCount; ++joint)
                    sums[vertex][joint] += weights[next][joint];
            }
        for (size_t vertex = 0; vertex < weights.size(); ++vertex)
            for (size_t joint = 0; joint < kJointCount; ++joint)
                weights[vertex][joint] = 0.5 * (weights[vertex][joint] + sums[vertex][joint] / neighbourCounts[vertex]);
    }
    return weights;
}

} // namespace antumbra::character
