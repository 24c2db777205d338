#include "gpu/area_truth.h"

#include <algorithm>
#include <optional>

namespace antumbra {

namespace {

using glm::dvec3;

struct Triangle
{
    dvec3 a, b, c; // relative to the point, counter-clockwise seen from outside

    [[nodiscard]] dvec3 normal() const { return glm::cross(b - a, c - a); }
};

std::vector<Triangle> trianglesAround(const dvec3& point, const scene::ConvexBody& body)
{
    std::vector<Triangle> triangles;
    for (uint32_t face = 0; face < body.faces.size(); ++face) {
        const auto loop = body.loop(face);
        const auto corner = [&](size_t i) { return dvec3(body.vertices[loop[i]]) - point; };
        for (size_t i = 1; i + 1 < loop.size(); ++i)
            triangles.push_back({corner(0), corner(i), corner(i + 1)});
    }
    return triangles;
}

/// How far along the direction the triangle is met: by the signs of the volumes that its edges make with the ray.
std::optional<double> distanceTo(const Triangle& triangle, const dvec3& direction)
{
    const double ab = glm::dot(direction, glm::cross(triangle.a, triangle.b)), bc = glm::dot(direction, glm::cross(triangle.b, triangle.c)),
                 ca = glm::dot(direction, glm::cross(triangle.c, triangle.a));
    const bool isWithin = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    const double slope = glm::dot(direction, triangle.normal());
    const double distance = slope != 0 ? glm::dot(triangle.a, triangle.normal()) / slope : -1;
    return isWithin && distance > 0 ? std::optional(distance) : std::nullopt;
}

struct Rays
{
    std::vector<Triangle> light, occluders;
    bool isTwoSided;

    explicit Rays(const app::AreaProblem& problem)
        : light(trianglesAround(problem.position, problem.light)), isTwoSided(problem.isTwoSided && problem.light.isPlanar)
    {
        for (const app::AreaOccluder& occluder : problem.occluders)
            for (const Triangle& triangle : trianglesAround(problem.position, occluder.body))
                occluders.push_back(triangle);
    }

    [[nodiscard]] std::optional<double> distanceToLight(const dvec3& direction) const
    {
        std::optional<double> nearest;
        for (const Triangle& triangle : light)
            if (isTwoSided || glm::dot(triangle.normal(), direction) < 0)
                if (const auto distance = distanceTo(triangle, direction); distance && !(nearest && *nearest < *distance))
                    nearest = distance;
        return nearest;
    }

    [[nodiscard]] bool isBlocked(const dvec3& direction, double before) const
    {
        return std::ranges::any_of(occluders, [&](const Triangle& triangle) {
            const auto distance = distanceTo(triangle, direction);
            return distance && *distance < before;
        });
    }
};

AreaShares oneRun(const app::AreaProblem& problem, const Rays& rays, const glm::dmat3& worldFromLobe, uint32_t gridSize,
                  RandomInputs& random)
{
    uint32_t lit = 0, seen = 0;
    for (uint32_t row = 0; row < gridSize; ++row)
        for (uint32_t column = 0; column < gridSize; ++column) {
            const double u = (row + random.uniform(0, 1)) / gridSize;
            const double angle = 2 * std::numbers::pi * (column + random.uniform(0, 1)) / gridSize;
            const dvec3 inLobe{std::sqrt(u) * std::cos(angle), std::sqrt(u) * std::sin(angle), std::sqrt(1 - u)};
            const dvec3 direction = worldFromLobe * inLobe;
            if (glm::dot(direction, dvec3(problem.normal)) <= 0)
                continue;
            const auto distance = rays.distanceToLight(direction);
            lit += distance ? 1 : 0;
            seen += distance && !rays.isBlocked(direction, *distance) ? 1 : 0;
        }
    const double count = static_cast<double>(gridSize) * gridSize;
    return {lit / count, seen / count};
}

} // namespace

SampledShares sampledShares(const app::AreaProblem& problem, uint32_t gridSize, uint32_t batches, RandomInputs& random)
{
    const dvec3 normal(problem.normal), tangent(problem.tangent);
    const glm::dmat3 worldFromFrame(tangent, glm::cross(normal, tangent), normal);
    const glm::dmat3 lobe = glm::transpose(glm::dmat3(problem.lobe[0], problem.lobe[1], problem.lobe[2]));
    const glm::dmat3 worldFromLobe = glm::inverse(lobe * glm::transpose(worldFromFrame));
    const Rays rays(problem);
    SampledShares result;
    AreaShares sum, squares;
    for (uint32_t batch = 0; batch < batches; ++batch) {
        const AreaShares run = oneRun(problem, rays, worldFromLobe, gridSize, random);
        sum.unoccluded += run.unoccluded;
        sum.visible += run.visible;
        squares.unoccluded += run.unoccluded * run.unoccluded;
        squares.visible += run.visible * run.visible;
    }
    const auto error = [&](double total, double totalOfSquares) {
        const double mean = total / batches;
        return std::sqrt(std::max(totalOfSquares / batches - mean * mean, 0.0) / (batches - 1));
    };
    result.shares = {sum.unoccluded / batches, sum.visible / batches};
    result.standardErrors = {error(sum.unoccluded, squares.unoccluded), error(sum.visible, squares.visible)};
    return result;
}

} // namespace antumbra
