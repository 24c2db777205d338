#include "graph/use.h"

#include <array>

namespace antumbra::graph {

Layout layoutOf(Use use)
{
    switch (use) {
    case Use::Sampled:
    case Use::DepthRead: return Layout::ReadOnly;
    case Use::ColorAttachment:
    case Use::DepthAttachment: return Layout::Attachment;
    case Use::TransferRead: return Layout::TransferSource;
    case Use::TransferWrite: return Layout::TransferTarget;
    case Use::Present: return Layout::Present;
    default: return Layout::General;
    }
}

bool writes(Use use)
{
    constexpr UseSet kWriting = Use::StorageWrite | Use::ColorAttachment | Use::DepthAttachment | Use::TransferWrite | Use::AccelWrite;
    return kWriting.contains(use);
}

bool isAttachment(Use use)
{
    constexpr UseSet kAttachments = Use::ColorAttachment | Use::DepthAttachment | Use::DepthRead;
    return kAttachments.contains(use);
}

bool suitsImages(Use use) { return use <= Use::Present; }

bool suitsBuffers(Use use)
{
    constexpr UseSet kBoth = Use::StorageRead | Use::StorageWrite | Use::TransferRead | Use::TransferWrite;
    return use > Use::Present || kBoth.contains(use);
}

std::string_view nameOf(Use use)
{
    constexpr std::array<std::string_view, kUseCount> kNames{
        "sampled",     "storage read",  "storage write",  "color attachment", "depth attachment",
        "depth read",  "transfer read", "transfer write", "present",          "accel build input",
        "accel write", "accel read",    "indirect",       "vertex read",      "host read",
    };
    return kNames[static_cast<size_t>(use)];
}

bool writes(UseSet uses)
{
    bool any = false;
    uses.forEach([&](Use use) { any |= writes(use); });
    return any;
}

Layout layoutOf(UseSet uses)
{
    Layout layout = Layout::Undefined;
    uses.forEach([&](Use use) { layout = layoutOf(use); });
    return layout;
}

} // namespace antumbra::graph
