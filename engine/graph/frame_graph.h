// The frame as it is declared: passes, what they read and write, and what the frame is for. Declaration order is execution order.
// It culls nothing and places no barrier (see plan.h), and touches no device (see executor.h).
#pragma once

#include "graph/pass.h"
#include "graph/resource.h"

#include <span>
#include <vector>

namespace antumbra::graph {

/// A pass that nobody declared, and why: "no DynamicSkinned in view".
struct SkippedPass
{
    std::string_view name;
    std::string_view reason;
};

/// What the frame is for; `after` is how it is used once the frame is over.
struct Output
{
    uint32_t resource = 0;
    UseSet after{};
};

/// One for each executor, reused every frame: after the first frames of a kind it allocates nothing.
class FrameGraph
{
public:
    /// Begins the next frame. Handles of the one before are stale.
    void reset();

    Pass add(std::string_view name);
    void skip(std::string_view pass, std::string_view reason);

    /// `initial` is how the image was used last: empty if its contents need not be kept. `desc.like` may size it.
    ImageRef import(std::string_view label, const ImageDesc& desc, ImportedImage image, UseSet initial);
    /// `initial` may stay empty: whatever came before is waited for.
    BufferRef importBuffer(std::string_view label, uint64_t bytes, ImportedBuffer buffer = {}, UseSet initial = {});
    /// Two images that change places every frame. `now` is an output: it must be written in every frame that declares it, and
    /// every frame that is declared must be executed. Once a frame and slot.
    History history(std::string_view label, const ImageDesc& desc, HistorySlot& slot);

    /// Keeps all passes that lead to what the resource holds at the end of the frame, and leaves it ready for `after`, which reads.
    void output(ImageRef image, UseSet after = {});
    void output(BufferRef buffer, UseSet after = {});

    [[nodiscard]] std::span<const PassNode> passes() const { return passes_; }
    [[nodiscard]] std::span<const Access> accesses(const PassNode& pass) const;
    [[nodiscard]] std::span<const Resource> resources() const { return resources_; }
    [[nodiscard]] std::span<const SkippedPass> skipped() const { return skipped_; }
    [[nodiscard]] std::span<const Output> outputs() const { return outputs_; }
    /// Versions of all resources are numbered 0..versionCount() in the order they were made.
    [[nodiscard]] uint32_t versionCount() const { return versionCount_; }
    /// Pixels; of any version of this frame.
    [[nodiscard]] uvec2 extent(ImageRef image) const;

private:
    friend class Pass;

    Handle addResource(const Resource& resource);
    Handle addImage(std::string_view label, const ImageDesc& desc, Origin origin);
    Handle addBuffer(std::string_view label, uint64_t bytes, Origin origin);
    void addOutput(Handle handle, UseSet after);

    // What Pass does, for images and buffers alike.
    Handle read(uint32_t pass, Handle handle, Use use);
    Handle write(uint32_t pass, Handle handle, Use use);
    Handle create(uint32_t pass, Handle handle, Use use);
    void addAccess(uint32_t pass, const Access& access);

    [[nodiscard]] Handle newest(uint32_t resource) const;
    void checkNewest(Handle handle, std::string_view user) const;

    std::vector<PassNode> passes_;
    std::vector<Access> accesses_;
    std::vector<Resource> resources_;
    std::vector<SkippedPass> skipped_;
    std::vector<Output> outputs_;
    uint64_t frame_ = 1;
    uint32_t versionCount_ = 0;
    uint32_t firstVersion_ = 1; // handles count on over frames, so that one kept too long never fits
    uint32_t historyCount_ = 0;
};

} // namespace antumbra::graph
