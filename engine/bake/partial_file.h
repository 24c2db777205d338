// What is done of a bake, on disk: a head that says of what, then the record of every finished tile as they came, pass by pass. Files
// only grow, so that whoever is killed keeps all records that were whole; those of anything else, and damaged ones, are refused.
#pragma once

#include "bake/bake.h"
#include "bake/tile_record.h"
#include "base/file.h"

#include <cstdio>
#include <memory>

namespace antumbra::bake {

class PartialFile
{
public:
    /// A new one in place of what was there.
    static PartialFile started(const Path& path, uint64_t sceneHash, const BakeSettings& settings);
    /// Throws Error for a file that is not there, not one of these, or of another scene or other settings.
    static PartialFile resumed(const Path& path, uint64_t sceneHash, const BakeSettings& settings);

    /// Whole records, those that come next, as long as they are of `pass`: some MiB of them, and none at the end. A record at the very
    /// end that is cut short is forgotten. Throws Error for damage.
    Bytes next(uint32_t pass);

    /// After the last was read. Whole records; they are in the file when this returns. Throws Error, for a full disk say.
    void append(std::span<const std::byte> records);

private:
    struct Close
    {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    explicit PartialFile(const Path& path);
    void readMore();

    Path path_;
    std::unique_ptr<std::FILE, Close> file_;
    Bytes read_;            // and not yet taken
    uint64_t position_ = 0; // in the file, of read_
    uint64_t size_ = 0;     // of the file
};

} // namespace antumbra::bake
