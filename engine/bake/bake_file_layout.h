// How a bake lies in its file: parts, channels, attributes. Shared by what writes and what reads it; does neither.
#pragma once

#include "bake/bake.h"

#include <string>
#include <vector>

namespace antumbra::bake {

inline constexpr int kBakeFileVersion = 3; // 3: five bands of local light

inline constexpr const char* kVersionAttribute = "antumbra:version";
inline constexpr const char* kSceneAttribute = "antumbra:scene";       // hash of the scene, 16 hexadecimal digits
inline constexpr const char* kChecksumAttribute = "antumbra:checksum"; // of all that is decoded, 16 hexadecimal digits
inline constexpr const char* kOriginAttribute = "antumbra:grid_origin";
inline constexpr const char* kSpacingAttribute = "antumbra:grid_spacing";
inline constexpr const char* kCountAttribute = "antumbra:grid_count";
/// Settings are floats named as their knobs.
std::string settingAttribute(std::string_view key);

inline constexpr const char* kTransferPart = "transfer";
inline constexpr const char* kVolumePart = "volume";

/// T00.R T00.G T00.B T01.R ..., in the order of TransferAtlas::planes.
std::vector<std::string> transferChannels(uint32_t coefficientCount);
/// M00_00.R ..., rows of the matrix first, in the order of IrradianceVolume::planes; then "open", one or zero.
std::vector<std::string> volumeChannels(uint32_t coefficientCount);

/// Slices z = 0, 1 ... below each other, so that pixels are in the order of cells.
uvec2 volumeExtent(const Grid& grid);

uint64_t checksumOf(const Bake& bake);
std::string hexadecimal(uint64_t value);

inline constexpr uint16_t kOpenHalf = 0x3c00; // one, of channel "open"

/// Rows are read and written by so many, or the pixels of a large atlas would take its memory twice.
inline constexpr uint32_t kRowsAtOnce = 64;

} // namespace antumbra::bake
