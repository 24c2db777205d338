// The binary data of a glTF file: its buffers, and its images as they are encoded. Nothing here is decoded or interpreted.
#pragma once

#include "base/file.h"
#include "scene/gltf_document.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace antumbra::scene {

/// Everything a glTF file refers to, by the names that took the place of the uris in the document.
struct GltfResources
{
    std::unordered_map<std::string, std::vector<std::byte>> bytes;
    std::vector<bool> isPlaceholder; // one a buffer: declared, but with no data behind it
};

/// Reads, within `folder`, all that the document (of valid schema) refers to, checks buffer views against their buffers, and
/// replaces every uri and every image's buffer view by a name. Afterwards no uri of the file is left that a parser could follow.
GltfResources takeResources(GltfDocument& document, const Path& folder);

} // namespace antumbra::scene
