// Bakes in files: multi-channel OpenEXR that any tool opens, the atlas its first part, the volume its second. Refuses what is stale,
// truncated, foreign or damaged, and never gives back a half of it.
#pragma once

#include "bake/bake.h"
#include "base/file.h"

#include <string>

namespace antumbra::bake {

/// Replaces the file at once or not at all; equal bakes give equal files. Throws Error where it cannot be written.
void saveBake(const Path& path, const Bake& bake);

/// Throws Error that says why: not there, not a bake of ours, of another version, cut short, damaged, values that are not finite, parts
/// that do not agree with its settings. Refuses more than a GiB a part before it takes any memory for it.
Bake loadBake(const Path& path);

/// Why a bake does not fit a scene: made of another scene, or with other settings (named). Empty where it does.
std::string staleness(const Bake& bake, uint64_t sceneHash, const BakeSettings& settings);

/// Where the bake of a scene lies: assets/bakes/NAME.exr for assets/scenes/NAME.json, which a NAME alone stands for; else NAME.bake.exr
/// beside the scene.
Path bakePathOf(const Path& scene);

} // namespace antumbra::bake
