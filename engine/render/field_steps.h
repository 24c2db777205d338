// Signed distance fields as the device evaluates them, step by step, and the same on the CPU in double. Sees no frame and no device.
#pragma once

#include "render/shader_structs.h"
#include "scene/shadow_components.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <optional>
#include <span>
#include <vector>

namespace antumbra::render {

/// The primitive in its place, without flags. Nothing where a parameter is not finite or `world` flattens it.
std::optional<shader::FieldStepBlock> fieldStep(const scene::SDFPrimitive& primitive, const mat4& world);

/// Metres from `point` to the nearest surface, negative inside a solid, never more than that; as shaders/lib/field.glsl has it.
/// Shapes under transforms that stretch unevenly, and what is cut or melted, come out nearer than they are.
double fieldDistance(std::span<const shader::FieldStepBlock> steps, const glm::dvec3& point);

/// A sphere that holds the step's shape, in the world. A plane's radius is kFieldUnbounded.
struct FieldBound
{
    vec3 centre{0};
    float radius = 0; // metres
};
inline constexpr float kFieldUnbounded = 1e9f;
FieldBound boundOf(const shader::FieldStepBlock& step);

/// How many of `count` steps are in one group at most: two where they are written out (render/field_structure.h), as groups that nobody
/// looks at are passed by; more where they are walked through, as each group's bounds are looked at first.
uint32_t mostInGroup(size_t count);

/// Divides steps into groups, which depends on nothing but their shapes, operations and flags, and bounds them. Keeps the memory of
/// `groups`.
void writeGroups(std::span<const shader::FieldStepBlock> steps, std::vector<shader::FieldGroupBlock>& groups);

/// As FieldsBlock has it.
uint32_t takesAway(std::span<const shader::FieldGroupBlock> groups);

/// Groups [first, end) whose solid is joined to all others by plain unions, so that each can be looked at alone.
struct FieldPart
{
    uint32_t firstGroup;
    uint32_t endGroup;
};
/// As small as they can be, in order. Keeps the memory of `parts`.
void writeParts(std::span<const shader::FieldStepBlock> steps, std::span<const shader::FieldGroupBlock> groups,
                std::vector<FieldPart>& parts);

} // namespace antumbra::render
