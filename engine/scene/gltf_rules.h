// What the schema cannot say: rules between the objects of a glTF file, and about its binary data.
// Each function throws Error{place and complaint} for the first rule that is broken, notes what can be repaired, and changes nothing.
#pragma once

#include "scene/gltf_document.h"
#include "scene/gltf_repairs.h"

#include <tiny_gltf.h>

#include <span>

namespace antumbra::scene {

/// How far a unit vector's or quaternion's length may be from one; covers normalised bytes.
inline constexpr double kUnitTolerance = 0.02;

/// Before parsing: the asset's version, and the extensions the file cannot be read without.
void checkVersionAndExtensions(const Json& root);

/// Accessors lie within their buffer views, are aligned, finite, and as wide as they claim.
void checkAccessors(const tinygltf::Model& file, Repairs& repairs);
/// Nodes form trees, scenes hold roots, skins have their matrices.
void checkNodes(const tinygltf::Model& file, Repairs& repairs);
void checkCameras(const tinygltf::Model& file);
/// Attributes have formats that fit their meaning, equal counts, indices in range; morph targets match.
void checkMeshes(const tinygltf::Model& file, Repairs& repairs);
/// Key times do not decrease, outputs match inputs and targets.
void checkAnimations(const tinygltf::Model& file, Repairs& repairs);

/// Vectors of `width` values of which the first `length` make the direction.
[[nodiscard]] bool areUnit(std::span<const float> values, size_t width, size_t length);

template <class T>
const T& at(const std::vector<T>& objects, int index)
{
    return objects[static_cast<size_t>(index)];
}

} // namespace antumbra::scene
