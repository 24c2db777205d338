// Where things are in the world: from Transform and Parent to WorldMatrix. Keeps no order of its own and allocates nothing.
#pragma once

#include "ecs/each.h"
#include "scene/components.h"

namespace antumbra::scene {

/// The longest chain of parents. Scene files are held to it; beyond it, and in a circle, updateWorldMatrices() stops the program.
inline constexpr uint32_t kGreatestDepth = 64;

mat4 localMatrix(const Transform& transform);

/// A system: before becomes now, and now follows from the chain of parents. A parent that is gone, or has no WorldMatrix,
/// counts as the world. Run it twice after loading, so that what stands still does not seem to have moved.
void updateWorldMatrices(ecs::Each<WorldMatrix, const Transform, ecs::Maybe<const Parent>> placed);

} // namespace antumbra::scene
