// A skinned model as the bytes of a glTF 2.0 binary file: the same model gives the same bytes. Writes no images and no morphs.
#pragma once

#include "scene/model.h"

#include <cstddef>
#include <vector>

namespace antumbra::character {

std::vector<std::byte> toGlb(const scene::Model& model);

} // namespace antumbra::character
