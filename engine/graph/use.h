// What a pass does with a resource. Everything a barrier must know follows from the uses on its two sides; how they are called in
// Vulkan is the executor's business.
#pragma once

#include <cstdint>
#include <string_view>

namespace antumbra::graph {

enum class Use : uint8_t {
    Sampled,         // image, by any shader
    StorageRead,     // image or buffer, by any shader
    StorageWrite,    // image or buffer, read and written by any shader
    ColorAttachment, // image, written, blended with what it holds
    DepthAttachment, // image, tested and written
    DepthRead,       // image, tested as depth attachment and not written; may be sampled in the same pass
    TransferRead,    // image or buffer
    TransferWrite,   // image or buffer
    Present,         // image, handed to the swapchain
    AccelBuildInput, // buffer: vertices, indices, instances, boxes of an acceleration structure build
    AccelWrite,      // buffer: scratch or result of a build
    AccelRead,       // buffer: traced by any shader, or referred to by a build one level up
    Indirect,        // buffer: arguments of indirect commands
    VertexRead,      // buffer, read by address in the vertex stage
    HostRead,        // buffer, read by the host once the frame is over
};

inline constexpr uint32_t kUseCount = 15;

/// The arrangement of an image's memory that a use asks for.
enum class Layout : uint8_t { Undefined, General, ReadOnly, Attachment, TransferSource, TransferTarget, Present };

Layout layoutOf(Use use);
bool writes(Use use);
bool isAttachment(Use use);
bool suitsImages(Use use);
bool suitsBuffers(Use use);
/// As in the picture and the JSON of the plan: "color attachment".
std::string_view nameOf(Use use);

/// A set of uses; those of one image that hold at the same time share a layout.
class UseSet
{
public:
    constexpr UseSet() = default;
    constexpr UseSet(Use use) : bits_(1u << static_cast<uint32_t>(use)) {}

    [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
    [[nodiscard]] constexpr bool contains(UseSet other) const { return (bits_ & other.bits_) == other.bits_; }

    constexpr UseSet& operator|=(UseSet other)
    {
        bits_ |= other.bits_;
        return *this;
    }
    friend constexpr UseSet operator|(UseSet a, UseSet b) { return a |= b; }
    friend constexpr bool operator==(UseSet, UseSet) = default;

    template <class F>
    constexpr void forEach(F&& visit) const
    {
        for (uint32_t use = 0; use < kUseCount; ++use)
            if (bits_ >> use & 1u)
                visit(static_cast<Use>(use));
    }

private:
    uint32_t bits_ = 0;
};

constexpr UseSet operator|(Use a, Use b) { return UseSet{a} | UseSet{b}; }

bool writes(UseSet uses);
/// Undefined for the empty set.
Layout layoutOf(UseSet uses);

} // namespace antumbra::graph
