// The bytes behind a glTF uri: data: or a file in the asset's own folder. Refuses schemes, absolute paths, "..", links that
// lead out of the folder, and everything that is not a regular file.
#pragma once

#include "base/file.h"

#include <string>
#include <string_view>
#include <vector>

namespace antumbra::scene {

struct DataUri
{
    std::string mediaType;
    std::vector<std::byte> bytes;
};

[[nodiscard]] bool isDataUri(std::string_view uri);
/// Throws Error for what is not well-formed base64.
DataUri decodeDataUri(std::string_view uri);
/// Throws Error for a uri that names nothing this folder may give.
std::vector<std::byte> readRelativeUri(const Path& folder, std::string_view uri, uint64_t greatestBytes);

} // namespace antumbra::scene
