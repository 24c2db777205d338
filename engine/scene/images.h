// Pictures in and out through OpenImageIO: HDR, EXR, PNG, JPEG, known by their first bytes and not by their names.
// Refuses more than 16384 pixels a side and more than 512 MiB decoded, before anything is allocated.
#pragma once

#include "base/file.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace antumbra::scene {

/// 8 bits a channel, RGBA, rows from the top.
struct Image8
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
};

/// Linear radiance or data, `channels` floats a pixel, rows from the top.
struct ImageF
{
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 3;
    std::vector<float> values;
};

/// An equirectangular map, 3 channels, W/(m^2 sr). Throws Error for what is not .hdr or .exr, for empty or broken pictures;
/// NaN, Inf and negative values are set to zero and counted in one warning.
ImageF loadRadiance(const Path& path);
/// Any picture as it stands in the file, linear where the format is.
ImageF loadImageF(const Path& path);
/// PNG or JPEG; `name` is what an Error calls it. Alpha is not multiplied in.
Image8 decodeImage8(std::span<const std::byte> encoded, const std::string& name);

/// Linear light of an sRGB value 0..1.
float srgbDecoded(float encoded);

void saveExr(const Path& path, const ImageF& image);
void savePng(const Path& path, const Image8& image);

} // namespace antumbra::scene
