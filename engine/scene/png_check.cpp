#include "scene/png_check.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace antumbra::scene {

namespace {

using Bytes = std::span<const std::byte>;

constexpr size_t kSignatureSize = 8;
constexpr size_t kFrameSize = 12; // length, type and checksum of a chunk

// CRC-32 of PNG (ISO 3309), by the table method.
constexpr std::array<uint32_t, 256> kCrcTable = [] {
    std::array<uint32_t, 256> table{};
    for (uint32_t i = 0; i < table.size(); ++i) {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit)
            table[i] = (table[i] & 1) != 0 ? table[i] >> 1 ^ 0xedb88320u : table[i] >> 1;
    }
    return table;
}();

uint32_t crcOf(Bytes bytes)
{
    uint32_t crc = ~0u;
    for (const std::byte byte : bytes)
        crc = crc >> 8 ^ kCrcTable[(crc ^ std::to_integer<uint32_t>(byte)) & 0xff];
    return ~crc;
}

uint32_t bigEndianAt(Bytes bytes, size_t offset)
{
    uint32_t word = 0;
    for (size_t i = 0; i < 4; ++i)
        word = word << 8 | std::to_integer<uint32_t>(bytes[offset + i]);
    return word;
}

} // namespace

bool isWholePng(Bytes file)
{
    size_t offset = kSignatureSize;
    while (offset + kFrameSize <= file.size()) {
        const size_t length = bigEndianAt(file, offset);
        if (length > file.size() - offset - kFrameSize)
            return false;
        if (crcOf(file.subspan(offset + 4, length + 4)) != bigEndianAt(file, offset + 8 + length))
            return false;
        if (std::memcmp(&file[offset + 4], "IEND", 4) == 0)
            return true;
        offset += kFrameSize + length;
    }
    return false;
}

} // namespace antumbra::scene
