// glTF 2.0 in: validates the whole file first, then builds. Reads nothing outside the file's own folder, no device, no network.
// Accepts what is wrong but can only be meant in one way, with a warning that names the repair.
// Refuses, by name, compressed geometry (Draco, meshopt) and required extensions it does not know.
#pragma once

#include "base/file.h"
#include "scene/model.h"

namespace antumbra::scene {

/// Throws Error{reason, file} for what is not valid or not supported; nothing half-loaded stays.
Model loadGltf(const Path& path);

/// What is in a glTF or an image file, for people: a few lines of text. Throws Error as the loaders do.
std::string inspect(const Path& path);

} // namespace antumbra::scene
