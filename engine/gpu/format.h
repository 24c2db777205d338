// Pixel formats the engine uses, and how they are called in Vulkan.
#pragma once

#include <cstdint>

namespace antumbra::gpu {

enum class Format {
    Undefined,
    R8Unorm,
    Rgba8Unorm,
    Rgba8Srgb,
    Bgra8Unorm,
    Bgra8Srgb,
    R16Float,
    Rg16Float,
    Rgba16Float,
    Rgba16Snorm,
    R32Float,
    Rg32Float,
    Rgba32Float,
    R32Uint,
    Rg32Uint,
    Rgba32Uint,
    Depth32Float,
};

/// Bytes of one pixel; 0 for Undefined.
constexpr uint32_t bytesPerPixel(Format format)
{
    switch (format) {
    case Format::Undefined: return 0;
    case Format::R8Unorm: return 1;
    case Format::R16Float: return 2;
    case Format::Rgba8Unorm:
    case Format::Rgba8Srgb:
    case Format::Bgra8Unorm:
    case Format::Bgra8Srgb:
    case Format::Rg16Float:
    case Format::R32Float:
    case Format::R32Uint:
    case Format::Depth32Float: return 4;
    case Format::Rgba16Float:
    case Format::Rgba16Snorm:
    case Format::Rg32Float:
    case Format::Rg32Uint: return 8;
    case Format::Rgba32Float:
    case Format::Rgba32Uint: return 16;
    }
    return 0;
}

constexpr bool isDepth(Format format) { return format == Format::Depth32Float; }

} // namespace antumbra::gpu
