// How much light a model sends on, as one number a channel.
#pragma once

#include "scene/model.h"

namespace antumbra::scene {

/// The mean over its area at rest, linear, 0..1; of a picture the mean of all of it. Black where there is no area.
vec3 meanAlbedo(const Model& model);

} // namespace antumbra::scene
