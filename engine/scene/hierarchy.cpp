#include "scene/hierarchy.h"

namespace antumbra::scene {

mat4 localMatrix(const Transform& transform)
{
    const mat3 rotation = glm::mat3_cast(transform.rotation);
    return {vec4(rotation[0] * transform.scale.x, 0), vec4(rotation[1] * transform.scale.y, 0), vec4(rotation[2] * transform.scale.z, 0),
            vec4(transform.position, 1)};
}

void updateWorldMatrices(ecs::Each<WorldMatrix, const Transform, ecs::Maybe<const Parent>> placed)
{
    // Each entity walks its own chain: scenes are shallow, and so nothing has to be sorted or remembered between frames.
    for (auto [matrix, transform, firstParent] : placed) {
        mat4 localToWorld = localMatrix(transform);
        const Parent* parent = firstParent;
        for (uint32_t depth = 0; parent != nullptr; ++depth) {
            check(depth < kGreatestDepth, "a chain of parents that ends");
            const auto above = placed.find(parent->entity);
            if (!above)
                break;
            localToWorld = localMatrix(std::get<1>(*above)) * localToWorld;
            parent = std::get<2>(*above);
        }
        matrix.before = matrix.now;
        matrix.now = localToWorld;
    }
}

} // namespace antumbra::scene
