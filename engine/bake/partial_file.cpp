#include "bake/partial_file.h"

#include "bake/bake_file.h"
#include "base/error.h"
#include "base/fnv1a.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace antumbra::bake {

namespace {

constexpr std::string_view kSignature = "antumbra partial bake 2\n";
constexpr size_t kReadAtOnce = size_t{8} << 20; // bytes

/// What a partial file is of, after the signature.
struct Head
{
    uint64_t sceneHash;
    BakeSettings settings;
    uint32_t padding;
    uint64_t checksum;
};
static_assert(sizeof(Head) == 48, "written as it lies in memory, so without holes");

Head headOf(uint64_t sceneHash, const BakeSettings& settings)
{
    Head head{sceneHash, settings, 0, 0};
    Fnv1a hash;
    hash.add(head);
    head.checksum = hash.value();
    return head;
}

Bytes bytesOf(const Head& head)
{
    const auto signature = std::as_bytes(std::span(kSignature));
    const auto rest = std::as_bytes(std::span(&head, 1));
    Bytes bytes(signature.begin(), signature.end());
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
}

} // namespace

PartialFile::PartialFile(const Path& path) : path_(path), file_(std::fopen(path.c_str(), "r+b"))
{
    if (!file_)
        throw Error(std::strerror(errno), path.string());
    size_ = std::filesystem::file_size(path);
}

PartialFile PartialFile::started(const Path& path, uint64_t sceneHash, const BakeSettings& settings)
{
    writeFile(path, bytesOf(headOf(sceneHash, settings)));
    PartialFile file(path);
    file.position_ = file.size_;
    return file;
}

PartialFile PartialFile::resumed(const Path& path, uint64_t sceneHash, const BakeSettings& settings)
{
    if (!std::filesystem::is_regular_file(path))
        throw Error("there is nothing to go on from: no such file", path.string());
    PartialFile file(path);
    Bytes bytes(kSignature.size() + sizeof(Head));
    const size_t count = std::fread(bytes.data(), 1, bytes.size(), file.file_.get());
    if (count < bytes.size() || std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) != 0)
        throw Error("not what this program keeps of an unfinished bake", path.string());
    Head found;
    std::memcpy(&found, &bytes[kSignature.size()], sizeof found);
    if (found.checksum != headOf(found.sceneHash, found.settings).checksum)
        throw Error("damaged: a checksum is wrong", path.string());
    const Bake begun{.settings = found.settings, .sceneHash = found.sceneHash, .atlas = {}, .volume = {}};
    if (const std::string reason = staleness(begun, sceneHash, settings); !reason.empty())
        throw Error("cannot go on from it: " + reason, path.string());
    file.position_ = bytes.size();
    return file;
}

void PartialFile::readMore()
{
    const size_t before = read_.size();
    read_.resize(before + std::min<uint64_t>(kReadAtOnce, size_ - position_ - before));
    if (std::fread(&read_[before], 1, read_.size() - before, file_.get()) != read_.size() - before)
        throw Error("cannot be read to its end", path_.string());
}

Bytes PartialFile::next(uint32_t pass)
{
    size_t taken = 0;
    while (taken < kReadAtOnce) {
        const std::optional<TakenRecord> found = takeRecord(std::span(read_).subspan(taken), path_.string());
        if (found && found->record.pass != pass)
            break;
        if (found)
            taken += found->size;
        else if (position_ + read_.size() < size_)
            readMore();
        else
            break;
    }
    Bytes records(read_.begin(), read_.begin() + static_cast<std::ptrdiff_t>(taken));
    read_.erase(read_.begin(), read_.begin() + static_cast<std::ptrdiff_t>(taken));
    position_ += taken;
    return records;
}

void PartialFile::append(std::span<const std::byte> records)
{
    std::FILE* file = file_.get();
    if (position_ < size_) {
        // A record that was cut short.
        read_.clear();
        std::filesystem::resize_file(path_, position_);
    }
    std::fseek(file, 0, SEEK_END);
    if (std::fwrite(records.data(), 1, records.size(), file) != records.size() || std::fflush(file) != 0)
        throw Error(std::strerror(errno), path_.string());
    position_ += records.size();
    size_ = position_;
}

} // namespace antumbra::bake
