#include "scene/principal_axis.h"

namespace antumbra::scene {

// By power iteration on the covariance.
vec3 principalAxis(std::span<const vec3> points, vec3 centre)
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

} // namespace antumbra::scene
