// What shines and what blocks, as bodies: made once from the components of a scene. Draws nothing, and follows no change of a light's
// shape.
#pragma once

#include "ecs/world.h"
#include "scene/assets.h"

namespace antumbra::app {

/// After populate(). Gives every AreaLight its LightBodies, every Occluder with a mesh its OccluderBodies, and every SDFPrimitive of bones
/// its FieldCapsules. Curved lights have flat faces; a mesh that is not closed and convex shines by its triangles. Hulls that are not their
/// mesh itself are hollow. Throws Error that names `subject`, the scene, for a light of a mesh that it does not have, or one that is too
/// fine, and for bones of what is not DynamicSkinned.
void makeShadowBodies(ecs::World& world, scene::Assets& assets, const std::string& subject);

} // namespace antumbra::app
