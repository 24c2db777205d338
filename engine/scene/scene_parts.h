// The parts of a scene file's entity that have a form of their own. Internal to scene_file.cpp.
#pragma once

#include "scene/json_object.h"
#include "scene/scene_file.h"

namespace antumbra::scene {

// Each takes the part's own object and throws Error as loadScene() does.
Transform readTransform(const JsonObject& part);
Material readMaterial(const JsonObject& part);
SceneAnimation readAnimation(const JsonObject& part);
Orbit readOrbit(const JsonObject& part);
AreaLight readAreaLight(const JsonObject& part);
Occluder readOccluder(const JsonObject& part);
/// Adds the name of the field it is of to `fields` where it is not there yet.
SDFPrimitive readSDFPrimitive(const JsonObject& part, std::vector<std::string>& fields);

} // namespace antumbra::scene
