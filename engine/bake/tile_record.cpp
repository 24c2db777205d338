#include "bake/tile_record.h"

#include "base/error.h"
#include "base/fnv1a.h"

#include <cstring>

namespace antumbra::bake {

namespace {

/// Ahead of a record's values and flags.
struct RecordHead
{
    uint32_t pass;
    uint32_t tile;
    uint64_t valueBytes;
    uint64_t flagBytes;
    uint64_t checksum; // of all else
};
static_assert(sizeof(RecordHead) == 32, "no padding");

uint64_t checksumOf(const TileRecord& record)
{
    Fnv1a hash;
    hash.add(record.pass);
    hash.add(record.tile);
    hash.add(uint64_t{record.values.size()});
    hash.add(record.values);
    hash.add(record.flags);
    return hash.value();
}

} // namespace

void appendRecord(Bytes& records, const TileRecord& record)
{
    const RecordHead head{record.pass, record.tile, record.values.size(), record.flags.size(), checksumOf(record)};
    const auto headBytes = std::as_bytes(std::span(&head, 1));
    records.insert(records.end(), headBytes.begin(), headBytes.end());
    records.insert(records.end(), record.values.begin(), record.values.end());
    records.insert(records.end(), record.flags.begin(), record.flags.end());
}

std::optional<TakenRecord> takeRecord(std::span<const std::byte> records, const std::string& subject)
{
    RecordHead head;
    if (records.size() < sizeof head)
        return std::nullopt;
    std::memcpy(&head, records.data(), sizeof head);
    const std::span<const std::byte> rest = records.subspan(sizeof head);
    if (head.valueBytes > rest.size() || head.flagBytes > rest.size() - head.valueBytes)
        return std::nullopt;
    const TakenRecord taken{.record = {.pass = head.pass,
                                       .tile = head.tile,
                                       .values = rest.first(head.valueBytes),
                                       .flags = rest.subspan(head.valueBytes, head.flagBytes)},
                            .size = sizeof head + head.valueBytes + head.flagBytes};
    if (checksumOf(taken.record) != head.checksum)
        throw Error("damaged: a checksum is wrong", subject);
    return taken;
}

} // namespace antumbra::bake
