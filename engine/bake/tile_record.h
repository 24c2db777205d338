// Finished tiles as bytes: what processes tell each other, and what the partial file is made of. Knows nothing of what they hold.
#pragma once

#include "bake/peers.h"

#include <optional>
#include <span>
#include <string>

namespace antumbra::bake {

/// What was gathered for one tile of one pass.
struct TileRecord
{
    uint32_t pass = 0;
    uint32_t tile = 0;
    std::span<const std::byte> values;
    std::span<const std::byte> flags;
};

void appendRecord(Bytes& records, const TileRecord& record);

/// A record, whose spans point into the bytes it was taken from, and the bytes it took.
struct TakenRecord
{
    TileRecord record;
    size_t size = 0;
};
/// The first record of `records`: nothing where they end before it does. Throws Error, about `subject`, where its checksum is wrong.
std::optional<TakenRecord> takeRecord(std::span<const std::byte> records, const std::string& subject);

} // namespace antumbra::bake
