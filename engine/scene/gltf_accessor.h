// Numbers out of a parsed and checked glTF: any component type, normalised, interleaved, sparse, or absent (zeros).
#pragma once

#include "base/math.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

namespace antumbra::scene {

/// Where the elements of an accessor lie; matrices of 1- and 2-byte components have padded columns.
struct ElementLayout
{
    size_t columns = 1;
    size_t rows = 1;
    size_t componentSize = 1; // bytes
    size_t columnStride = 1;
    size_t size = 1; // with all padding

    [[nodiscard]] size_t components() const { return columns * rows; }
    /// Bytes from the first component to the end of the last: the last element need not be padded.
    [[nodiscard]] size_t extent() const { return size - columnStride + rows * componentSize; }
};

[[nodiscard]] ElementLayout layoutOf(const tinygltf::Accessor& accessor);
/// Bytes from one element to the next.
[[nodiscard]] size_t strideOf(const tinygltf::Model& file, const tinygltf::Accessor& accessor);
/// False where the file gives no bytes: no buffer view and not sparse, or a placeholder buffer.
[[nodiscard]] bool hasData(const tinygltf::Model& file, const tinygltf::Accessor& accessor);

/// components() values an element, one element after the other.
std::vector<double> readRaw(const tinygltf::Model& file, const tinygltf::Accessor& accessor);
/// Normalised integers become -1..1 or 0..1.
std::vector<float> readFloats(const tinygltf::Model& file, const tinygltf::Accessor& accessor);
std::vector<uint32_t> readIntegers(const tinygltf::Model& file, const tinygltf::Accessor& accessor);
/// `T` is vec2, vec3, vec4 or mat4 and the accessor of that type.
template <class T>
std::vector<T> readAs(const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    const std::vector<float> floats = readFloats(file, accessor);
    std::vector<T> elements(accessor.count);
    std::copy(floats.begin(), floats.end(), reinterpret_cast<float*>(elements.data()));
    return elements;
}

} // namespace antumbra::scene
