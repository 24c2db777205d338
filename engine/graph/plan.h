// What a declared frame comes down to: which passes run, the barriers before each, and which transients share memory. Computed from
// the declaration alone; needs no device.
#pragma once

#include "graph/frame_graph.h"

#include <span>
#include <string>
#include <vector>

namespace antumbra::graph {

/// Waits for `from` and makes the resource ready for `to`; an image goes from layoutOf(from) to layoutOf(to).
struct Barrier
{
    uint32_t resource = 0;
    UseSet from;          // empty: whatever came before, in this frame or an earlier one
    UseSet to;            // all uses until the next barrier of the resource
    bool discard = false; // what the memory holds is not kept: the image's old layout is Undefined

    friend bool operator==(const Barrier&, const Barrier&) = default;
};

enum class Load : uint8_t { Keep, Clear, Discard };

struct Attachment
{
    uint32_t resource = 0;
    Use use = Use::ColorAttachment;
    Load load = Load::Keep; // Clear: to the resource's `image.clear`
    bool store = true;      // false: nobody needs it after this pass

    friend bool operator==(const Attachment&, const Attachment&) = default;
};

struct Range
{
    uint32_t first = 0;
    uint32_t count = 0;

    friend bool operator==(Range, Range) = default;
};

struct Step
{
    uint32_t pass = 0; // index into FrameGraph::passes()
    Range barriers{};
    Range attachments{}; // in the order of declaration

    friend bool operator==(const Step&, const Step&) = default;
};

/// Beside FrameGraph::resources(), index for index.
struct PlannedResource
{
    UseSet uses;              // all of the frame; for history images those of the pair
    UseSet left;              // the last ones: how the frame leaves it
    uint32_t first = kNone;   // step; kNone: no step uses it
    uint32_t last = kNone;    // step; for outputs the number of steps
    uint32_t memory = kNone;  // transients: index into Plan::memory
    uint32_t barrier = kNone; // its last one

    friend bool operator==(const PlannedResource&, const PlannedResource&) = default;
};

/// Memory that transients of one kind use in turn; needs room for the greatest of them.
struct SharedMemory
{
    Kind kind = Kind::Image;
    uint64_t bytes = 0;
    uint32_t occupant = kNone; // the resource that has it last

    friend bool operator==(const SharedMemory&, const SharedMemory&) = default;
};

/// A pass that does not run: skipped for `reason`, or culled since nothing reads `unread` (empty: it writes nothing).
struct AbsentPass
{
    std::string_view name;
    std::string_view reason;
    std::string_view unread;

    friend bool operator==(const AbsentPass&, const AbsentPass&) = default;
};

struct Plan
{
    std::vector<Step> steps;
    std::vector<Barrier> barriers;
    std::vector<Attachment> attachments;
    Range finalBarriers; // after the last step: outputs made ready for what comes after the frame
    std::vector<PlannedResource> resources;
    std::vector<uint32_t> transients; // resources that need memory, the greatest first
    std::vector<SharedMemory> memory;
    std::vector<AbsentPass> absent;
    std::vector<uint32_t> readers; // how many steps and outputs need each version

    [[nodiscard]] std::span<const Barrier> barriersOf(Range range) const { return std::span{barriers}.subspan(range.first, range.count); }
    [[nodiscard]] std::span<const Attachment> attachmentsOf(const Step& step) const
    {
        return std::span{attachments}.subspan(step.attachments.first, step.attachments.count);
    }

    friend bool operator==(const Plan&, const Plan&) = default;
};

/// A history image that no pass writes fails a check that names it.
Plan compile(const FrameGraph& graph);
/// The same into `plan`, whose memory is used again.
void compile(const FrameGraph& graph, Plan& plan);
/// One line: "nothing reads 'occluded irradiance'".
std::string reasonOf(const AbsentPass& pass);

} // namespace antumbra::graph
