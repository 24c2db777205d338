// GLM under the project's conventions: right-handed, Y up, radians, depth 0..1 (DESIGN.md, Conventions).
#pragma once

#ifndef GLM_FORCE_DEPTH_ZERO_TO_ONE
#error "GLM's settings come from the build: include engine headers through the antumbra targets"
#endif

#include <glm/glm.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <numbers>

namespace antumbra {

using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = std::numbers::pi_v<float>;

} // namespace antumbra
