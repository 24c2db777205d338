#include "scene/gltf_accessor.h"

#include "base/check.h"

#include <algorithm>
#include <cstring>

namespace antumbra::scene {

namespace {

template <class T>
double valueAt(const unsigned char* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double componentAt(const unsigned char* bytes, int componentType)
{
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return valueAt<int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return valueAt<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return valueAt<int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return valueAt<uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return valueAt<uint32_t>(bytes);
    default: return valueAt<float>(bytes);
    }
}

void copyElement(double* to, const unsigned char* from, const ElementLayout& layout, int componentType)
{
    for (size_t column = 0; column < layout.columns; ++column)
        for (size_t row = 0; row < layout.rows; ++row)
            *to++ = componentAt(from + column * layout.columnStride + row * layout.componentSize, componentType);
}

// Null where the view's buffer is a placeholder.
const unsigned char* bytesOf(const tinygltf::Model& file, int bufferView, size_t offset)
{
    const tinygltf::BufferView& view = file.bufferViews[static_cast<size_t>(bufferView)];
    const std::vector<unsigned char>& data = file.buffers[static_cast<size_t>(view.buffer)].data;
    return data.empty() ? nullptr : data.data() + view.byteOffset + offset;
}

void overwriteSparse(std::vector<double>& values, const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    const ElementLayout layout = layoutOf(accessor);
    const auto& [count, isSparse, indices, overrides] = accessor.sparse;
    const auto indexType = indices.componentType;
    const auto indexSize = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(indexType)));
    const unsigned char* index = bytesOf(file, indices.bufferView, static_cast<size_t>(indices.byteOffset));
    const unsigned char* value = bytesOf(file, overrides.bufferView, static_cast<size_t>(overrides.byteOffset));
    if (index == nullptr || value == nullptr)
        return;
    for (int i = 0; i < count; ++i, index += indexSize, value += layout.size) {
        const auto element = static_cast<size_t>(componentAt(index, indexType));
        copyElement(&values[element * layout.components()], value, layout, accessor.componentType);
    }
}

double greatestOf(int componentType)
{
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return 127;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 255;
    case TINYGLTF_COMPONENT_TYPE_SHORT: return 32767;
    default: return 65535;
    }
}

} // namespace

ElementLayout layoutOf(const tinygltf::Accessor& accessor)
{
    ElementLayout layout;
    layout.componentSize = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType)));
    const auto components = static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
    const bool isMatrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 || accessor.type == TINYGLTF_TYPE_MAT4;
    layout.columns = !isMatrix ? 1 : components == 4 ? 2 : components == 9 ? 3 : 4;
    layout.rows = components / layout.columns;
    const size_t columnSize = layout.rows * layout.componentSize;
    layout.columnStride = isMatrix ? (columnSize + 3) / 4 * 4 : columnSize;
    layout.size = layout.columns * layout.columnStride;
    return layout;
}

size_t strideOf(const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    const size_t stride = accessor.bufferView < 0 ? 0 : file.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
    return stride != 0 ? stride : layoutOf(accessor).size;
}

bool hasData(const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    if (accessor.bufferView < 0)
        return accessor.sparse.isSparse;
    return bytesOf(file, accessor.bufferView, 0) != nullptr;
}

std::vector<double> readRaw(const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    const ElementLayout layout = layoutOf(accessor);
    std::vector<double> values(accessor.count * layout.components());
    const unsigned char* bytes = accessor.bufferView < 0 ? nullptr : bytesOf(file, accessor.bufferView, accessor.byteOffset);
    if (bytes != nullptr)
        for (size_t i = 0; i < accessor.count; ++i)
            copyElement(&values[i * layout.components()], bytes + i * strideOf(file, accessor), layout, accessor.componentType);
    if (accessor.sparse.isSparse)
        overwriteSparse(values, file, accessor);
    return values;
}

std::vector<float> readFloats(const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    const std::vector<double> raw = readRaw(file, accessor);
    std::vector<float> floats(raw.size());
    const double scale = accessor.normalized ? 1 / greatestOf(accessor.componentType) : 1;
    std::transform(raw.begin(), raw.end(), floats.begin(),
                   [&](double value) { return static_cast<float>(accessor.normalized ? std::max(value * scale, -1.0) : value); });
    return floats;
}

std::vector<uint32_t> readIntegers(const tinygltf::Model& file, const tinygltf::Accessor& accessor)
{
    const std::vector<double> raw = readRaw(file, accessor);
    std::vector<uint32_t> integers(raw.size());
    std::transform(raw.begin(), raw.end(), integers.begin(), [](double value) { return static_cast<uint32_t>(value); });
    return integers;
}

} // namespace antumbra::scene
