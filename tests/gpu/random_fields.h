// Distance fields to test with: steps of every shape and operation, in places that turn, scale, stretch and shear them.
#pragma once

#include "gpu/random_inputs.h"
#include "render/field_steps.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace antumbra {

using FieldSteps = std::vector<shader::FieldStepBlock>;

/// Flags the first step as the start of a field.
inline FieldSteps fieldOf(const std::vector<scene::SDFPrimitive>& primitives, const mat4& world = mat4{1})
{
    FieldSteps steps;
    for (const scene::SDFPrimitive& primitive : primitives)
        steps.push_back(render::fieldStep(primitive, world).value());
    if (!steps.empty())
        steps[0].flags = shader::kFieldBegins;
    return steps;
}

/// About a metre in size, within two metres of the origin.
inline scene::SDFPrimitive randomPrimitive(RandomInputs& random)
{
    const auto place = [&] { return vec3(random.direction() * random.uniform(0, 2)); };
    const auto length = [&] { return static_cast<float>(random.logUniform(0.02, 1)); };
    scene::SDFPrimitive primitive;
    primitive.shape = static_cast<scene::SDFShape>(random.index(8));
    primitive.centre = place();
    primitive.end = random.index(8) == 0 ? primitive.centre : place();
    primitive.halfExtent = {length(), length(), length()};
    primitive.direction = vec3(random.direction());
    primitive.radius = length();
    primitive.minorRadius = random.index(4) == 0 ? 0 : length();
    primitive.height = length();
    primitive.offset = static_cast<float>(random.uniform(-1, 1));
    primitive.operation = static_cast<scene::SDFOperation>(random.index(4));
    primitive.blend = random.index(8) == 0 ? 0 : length();
    return primitive;
}

/// Every third turns and scales alike, every third stretches along axes of its own, every third shears too.
inline mat4 randomPlace(RandomInputs& random)
{
    const auto turn = [&] { return glm::mat4_cast(glm::angleAxis(static_cast<float>(random.uniform(0, 6)), vec3(random.direction()))); };
    const auto stretch = [&] { return static_cast<float>(random.logUniform(0.2, 3)); };
    const mat4 moved = glm::translate(mat4{1}, vec3(random.direction())) * turn();
    const uint32_t kind = random.index(3);
    if (kind == 0)
        return glm::scale(moved, vec3(stretch()));
    const mat4 stretched = glm::scale(moved, {stretch(), stretch(), stretch()});
    return kind == 1 ? stretched : glm::scale(stretched * turn(), {stretch(), stretch(), stretch()});
}

/// Of `count` steps, in one to three fields.
inline FieldSteps randomField(RandomInputs& random, uint32_t count)
{
    FieldSteps steps;
    for (uint32_t i = 0; i < count; ++i) {
        steps.push_back(render::fieldStep(randomPrimitive(random), randomPlace(random)).value());
        steps.back().flags = i == 0 || random.index(6) == 0 ? shader::kFieldBegins : 0u;
    }
    return steps;
}

} // namespace antumbra
