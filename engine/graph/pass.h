// One pass as it is declared: what it reads and writes, and the commands it would record. Runs nothing.
#pragma once

#include "base/inplace_function.h"
#include "graph/resource.h"

#include <string_view>

namespace antumbra::graph {

class FrameGraph;
class Recorder;

using Commands = InplaceFunction<void(Recorder&), 256>;

/// Declares one pass, until the next is added. Labels and names are views: of literals, or of text that outlives the frame.
class Pass
{
public:
    /// Returns the handle it was given. A stale version, or a use that writes, fails a check that names the resource. One pass may
    /// read a resource in several uses if an image's layout is the same for all.
    ImageRef read(ImageRef image, Use use);
    BufferRef read(BufferRef buffer, Use use);
    /// Keeps what the pass leaves untouched: it depends on the version it retires. A pass writes a resource once.
    [[nodiscard]] ImageRef write(ImageRef image, Use use);
    [[nodiscard]] BufferRef write(BufferRef buffer, Use use);
    /// Memory for this frame only, shared with what lives before and after; its contents are undefined but for `desc.clear`.
    [[nodiscard]] ImageRef create(std::string_view label, const ImageDesc& desc, Use use);
    [[nodiscard]] BufferRef createBuffer(std::string_view label, uint64_t bytes, Use use);

    /// The pass survives although nothing reads what it writes.
    Pass& sideEffect();
    /// Called by the executor if the pass survives.
    void record(Commands commands);

private:
    friend class FrameGraph;
    Pass(FrameGraph& graph, uint32_t index) : graph_(&graph), index_(index) {}

    FrameGraph* graph_;
    uint32_t index_;
};

/// `before` is the version that is needed (kNone for a new resource), `after` the one that is made (kNone for a read).
struct Access
{
    uint32_t resource = 0;
    uint32_t before = kNone;
    uint32_t after = kNone;
    Use use = Use::Sampled;
};

struct PassNode
{
    std::string_view name;
    uint32_t firstAccess = 0;
    uint32_t accessCount = 0;
    bool sideEffect = false;
    Commands commands;
};

} // namespace antumbra::graph
