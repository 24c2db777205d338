#include "scene/gltf_document.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace antumbra::scene {

namespace {

constexpr uint32_t kMagic = 0x46546c67;     // "glTF"
constexpr uint32_t kJsonChunk = 0x4e4f534a; // "JSON"
constexpr uint32_t kBinChunk = 0x004e4942;  // "BIN"
constexpr size_t kHeaderSize = 12;
constexpr size_t kChunkHeaderSize = 8;
constexpr int kDeepestNesting = 64;
constexpr size_t kGreatestText = size_t{64} << 20; // bytes; the tree takes several times as much

using Bytes = std::span<const std::byte>;

// Little-endian, as glTF and every machine this engine runs on.
uint32_t wordAt(Bytes bytes, size_t offset)
{
    uint32_t word = 0;
    std::memcpy(&word, &bytes[offset], sizeof word);
    return word;
}

struct Chunks
{
    Bytes json;
    Bytes binary;
};

void checkHeader(Bytes file)
{
    require(file.size() >= kHeaderSize + kChunkHeaderSize, "the GLB ends before its first chunk");
    require(wordAt(file, 4) == 2, "GLB version {} is not 2", wordAt(file, 4));
    require(wordAt(file, 8) <= file.size(), "the GLB is truncated: its header says {} bytes, the file has {}", wordAt(file, 8),
            file.size());
}

Chunks splitChunks(Bytes file)
{
    checkHeader(file);
    Chunks chunks;
    const size_t end = wordAt(file, 8);
    size_t offset = kHeaderSize;
    while (offset < end) {
        require(end - offset >= kChunkHeaderSize, "the GLB ends within a chunk's header");
        const size_t length = wordAt(file, offset);
        const uint32_t type = wordAt(file, offset + 4);
        const bool isFirst = offset == kHeaderSize;
        offset += kChunkHeaderSize;
        require(length <= end - offset, "a GLB chunk of {} bytes reaches beyond the file", length);
        require(length % 4 == 0, "a GLB chunk's length of {} is not a multiple of 4", length);
        require((type == kJsonChunk) == isFirst, "the GLB's first chunk, and no other, must be JSON");
        if (isFirst)
            chunks.json = file.subspan(offset, length);
        if (type == kBinChunk) {
            require(chunks.binary.empty(), "the GLB has two BIN chunks");
            chunks.binary = file.subspan(offset, length);
        }
        offset += length;
    }
    return chunks;
}

// Before parsing: the parser calls itself once a level, and so does whoever walks its tree.
void checkNesting(std::string_view text)
{
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            require(++depth <= kDeepestNesting, "JSON is nested deeper than {} levels", kDeepestNesting);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

Json parse(Bytes bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    require(text.size() <= kGreatestText, "{} bytes of JSON are more than the limit of {}", text.size(), kGreatestText);
    require(!text.starts_with("\xef\xbb\xbf"), "JSON must not begin with a byte order mark");
    checkNesting(text);
    try {
        return Json::parse(text);
    } catch (const Json::exception& failure) {
        // The library puts its own error number in brackets first.
        const std::string_view message = failure.what();
        const size_t bracket = message.find("] ");
        throw Error("JSON: " + std::string(message.substr(bracket == std::string_view::npos ? 0 : bracket + 2)), "");
    }
}

} // namespace

GltfDocument readDocument(std::span<const std::byte> file)
{
    require(!file.empty(), "the file is empty");
    if (file.size() < sizeof kMagic || wordAt(file, 0) != kMagic)
        return {parse(file), false, {}};
    const Chunks chunks = splitChunks(file);
    return {parse(chunks.json), true, {chunks.binary.begin(), chunks.binary.end()}};
}

} // namespace antumbra::scene
