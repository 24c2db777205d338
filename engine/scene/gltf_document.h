// The outer shell of a glTF file: container, text and JSON tree. Looks at no glTF property but the asset's version.
#pragma once

#include "base/error.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace antumbra::scene {

using Json = nlohmann::json;

/// Throws Error{complaint} unless `holds`; the caller who knows the file adds its name.
template <class... Args>
void require(bool holds, fmt::format_string<Args...> complaint, Args&&... args)
{
    if (!holds)
        throw Error(fmt::format(complaint, std::forward<Args>(args)...), "");
}

struct GltfDocument
{
    Json root;
    bool isGlb = false;
    std::vector<std::byte> binary; // the GLB's BIN chunk
};

/// Takes .glb and .gltf alike. Refuses broken chunks, nesting deeper than 64 and everything that is not strict JSON in UTF-8.
GltfDocument readDocument(std::span<const std::byte> file);

} // namespace antumbra::scene
