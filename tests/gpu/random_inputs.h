// Inputs that are the same on every run and every platform: std's distributions are not.
#pragma once

#include "base/math.h"

#include <cmath>
#include <random>
#include <vector>

namespace antumbra {

class RandomInputs
{
public:
    explicit RandomInputs(uint32_t seed) : engine_(seed) {}

    /// In [least, greatest).
    double uniform(double least, double greatest) { return least + (greatest - least) * (engine_() / 4294967296.0); }
    /// Every decade alike.
    double logUniform(double least, double greatest) { return std::exp(uniform(std::log(least), std::log(greatest))); }
    uint32_t index(uint32_t count) { return static_cast<uint32_t>(uniform(0, count)); }
    /// Evenly over the sphere.
    glm::dvec3 direction()
    {
        const double z = uniform(-1, 1), phi = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    glm::dvec3 perpendicularTo(const glm::dvec3& axis)
    {
        const glm::dvec3 across = glm::cross(axis, direction());
        return glm::length(across) > 1e-3 ? glm::normalize(across) : perpendicularTo(axis);
    }

private:
    std::mt19937 engine_;
};

/// Unit vectors on the axes, the diagonals and the folds of the octahedron, exact and a hair beside.
inline std::vector<vec3> awkwardDirections()
{
    std::vector<vec3> directions;
    constexpr float kSteps[] = {-1, -1e-7f, -0.0f, 0, 1e-7f, 1};
    for (const float x : kSteps)
        for (const float y : kSteps)
            for (const float z : kSteps)
                if (const vec3 v(x, y, z); glm::length(v) > 0.5f)
                    directions.push_back(glm::normalize(v));
    return directions;
}

} // namespace antumbra
