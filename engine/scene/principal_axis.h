// The direction in which points are spread most.
#pragma once

#include "base/math.h"

#include <span>

namespace antumbra::scene {

/// Of unit length; of points that all lie together, some direction.
vec3 principalAxis(std::span<const vec3> points, vec3 centre);

} // namespace antumbra::scene
