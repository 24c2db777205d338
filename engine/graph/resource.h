// Images and buffers as the frame graph knows them: handles, descriptions, and where their memory comes from. Holds no memory itself.
#pragma once

#include "base/math.h"
#include "gpu/format.h"
#include "graph/use.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace antumbra::graph {

inline constexpr uint32_t kNone = ~0u;

/// One version of a resource. Writing retires it and makes the next; a version also goes stale when its frame is over.
struct Handle
{
    uint32_t index = kNone;
    uint32_t version = 0;

    explicit operator bool() const { return index != kNone; }
    friend bool operator==(Handle, Handle) = default;
};

struct ImageRef : Handle
{
};

struct BufferRef : Handle
{
};

struct ImageDesc
{
    gpu::Format format = gpu::Format::Undefined;
    uvec2 extent{0};             // pixels; taken from `like` where that is given
    ImageRef like{};             // another image, of any version
    float scale = 1;             // of like's extent, rounded up
    std::optional<vec4> clear{}; // what an attachment holds before its first pass; depth in x
};

/// The caller's name for an image or a buffer that outlives the frame; only the executor looks behind it.
enum class ImportedImage : uint64_t {};
enum class ImportedBuffer : uint64_t {};

/// Names a pair of images that live on over frames. A render system owns it; only the frame graph changes it.
struct HistorySlot
{
    uint32_t id = 0;   // given at the first use, never 0 then
    uint32_t side = 0; // 0 or 1: which of the pair is written this frame
    uint64_t frame = 0;
    gpu::Format format = gpu::Format::Undefined;
    uvec2 extent{0};
};

/// How history images are left at the end of a frame, and found by the next.
inline constexpr UseSet kHistoryAtRest = Use::Sampled;

/// What was written in the frame before, and what this frame must write.
struct History
{
    ImageRef before;
    ImageRef now;
    bool valid = false; // `before` holds the frame before, at the same format and extent; else its contents are undefined
};

enum class Kind : uint8_t { Image, Buffer };

/// Where the memory comes from: shared out within the frame, the caller's, or kept by the executor for a HistorySlot.
enum class Origin : uint8_t { Transient, Imported, HistoryBefore, HistoryNow };

struct Resource
{
    std::string_view label;
    Kind kind = Kind::Image;
    Origin origin = Origin::Transient;
    ImageDesc image{};    // extent resolved
    uint64_t bytes = 0;   // estimated from the format for images
    uint64_t token = 0;   // ImportedImage or ImportedBuffer; 2 * id + side of a HistorySlot
    UseSet initial{};     // uses before the frame; empty: any, and an image's contents are undefined
    uint32_t version = 0; // the newest one
    bool written = false; // by a pass of this frame
};

} // namespace antumbra::graph
