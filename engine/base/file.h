// Whole files in and out. Reading refuses what is not a regular file; writing replaces a file at once or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace antumbra {

using Path = std::filesystem::path;

/// Throws Error for a missing file, a folder, a device or a pipe, and for more than `greatestBytes`.
std::vector<std::byte> readFile(const Path& path, uint64_t greatestBytes = uint64_t{1} << 32);
std::string readText(const Path& path, uint64_t greatestBytes = uint64_t{1} << 28);

/// Writes beside the target and renames, so that a reader sees the old file or the new one. Makes missing folders.
void writeFile(const Path& path, std::span<const std::byte> bytes);
void writeText(const Path& path, std::string_view text);

/// The project's own folder `name` (shaders, assets): $ANTUMBRA_ROOT when set, else where the build was configured.
Path projectPath(std::string_view name);

} // namespace antumbra
