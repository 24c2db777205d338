#include "graph/frame_graph.h"

#include "graph/check_named.h"

#include <utility>

namespace antumbra::graph {

namespace {

uvec2 scaled(uvec2 extent, float scale) { return glm::max(uvec2{1}, uvec2{glm::ceil(vec2{extent} * scale)}); }

uint64_t estimatedBytes(const ImageDesc& desc) { return uint64_t{desc.extent.x} * desc.extent.y * gpu::bytesPerPixel(desc.format); }

// Transients are written before anybody holds a handle; what a HistorySlot held before its first frame may be bound, not trusted.
bool hasContents(const Resource& resource)
{
    return resource.written || resource.kind == Kind::Buffer || !resource.initial.empty() || resource.origin == Origin::HistoryBefore;
}

bool hasOneLayout(UseSet uses)
{
    bool same = true;
    uses.forEach([&](Use use) { same &= layoutOf(use) == layoutOf(uses); });
    return same;
}

} // namespace

ImageRef Pass::read(ImageRef image, Use use) { return {graph_->read(index_, image, use)}; }

BufferRef Pass::read(BufferRef buffer, Use use) { return {graph_->read(index_, buffer, use)}; }

ImageRef Pass::write(ImageRef image, Use use) { return {graph_->write(index_, image, use)}; }

BufferRef Pass::write(BufferRef buffer, Use use) { return {graph_->write(index_, buffer, use)}; }

ImageRef Pass::create(std::string_view label, const ImageDesc& desc, Use use)
{
    return {graph_->create(index_, graph_->addImage(label, desc, Origin::Transient), use)};
}

BufferRef Pass::createBuffer(std::string_view label, uint64_t bytes, Use use)
{
    return {graph_->create(index_, graph_->addBuffer(label, bytes, Origin::Transient), use)};
}

Pass& Pass::sideEffect()
{
    graph_->passes_[index_].sideEffect = true;
    return *this;
}

void Pass::record(Commands commands) { graph_->passes_[index_].commands = std::move(commands); }

void FrameGraph::reset()
{
    passes_.clear();
    accesses_.clear();
    resources_.clear();
    skipped_.clear();
    outputs_.clear();
    firstVersion_ += versionCount_;
    versionCount_ = 0;
    ++frame_;
}

Pass FrameGraph::add(std::string_view name)
{
    PassNode& node = passes_.emplace_back();
    node.name = name;
    node.firstAccess = static_cast<uint32_t>(accesses_.size());
    return {*this, static_cast<uint32_t>(passes_.size() - 1)};
}

void FrameGraph::skip(std::string_view pass, std::string_view reason) { skipped_.push_back({pass, reason}); }

ImageRef FrameGraph::import(std::string_view label, const ImageDesc& desc, ImportedImage image, UseSet initial)
{
    const Handle handle = addImage(label, desc, Origin::Imported);
    resources_[handle.index].token = static_cast<uint64_t>(image);
    resources_[handle.index].initial = initial;
    return {handle};
}

BufferRef FrameGraph::importBuffer(std::string_view label, uint64_t bytes, ImportedBuffer buffer, UseSet initial)
{
    const Handle handle = addBuffer(label, bytes, Origin::Imported);
    resources_[handle.index].token = static_cast<uint64_t>(buffer);
    resources_[handle.index].initial = initial;
    return {handle};
}

History FrameGraph::history(std::string_view label, const ImageDesc& desc, HistorySlot& slot)
{
    checkNamed(slot.frame != frame_, "the history '{}' to be declared once a frame", label);
    const Handle before = addImage(label, desc, Origin::HistoryBefore);
    const Handle now = addImage(label, desc, Origin::HistoryNow);
    const uvec2 extent = resources_[now.index].image.extent;

    if (slot.id == 0)
        slot.id = ++historyCount_;
    const bool valid = slot.frame + 1 == frame_ && slot.format == desc.format && slot.extent == extent;
    slot = {.id = slot.id, .side = 1 - slot.side, .frame = frame_, .format = desc.format, .extent = extent};

    const uint64_t token = uint64_t{2} * slot.id;
    resources_[before.index].token = token + 1 - slot.side;
    resources_[now.index].token = token + slot.side;
    if (valid)
        resources_[before.index].initial = kHistoryAtRest;
    addOutput(now, kHistoryAtRest);
    return {{before}, {now}, valid};
}

void FrameGraph::output(ImageRef image, UseSet after)
{
    checkNewest(image, "an output");
    addOutput(image, after);
}

void FrameGraph::output(BufferRef buffer, UseSet after)
{
    checkNewest(buffer, "an output");
    addOutput(buffer, after);
}

void FrameGraph::addOutput(Handle handle, UseSet after)
{
    const std::string_view label = resources_[handle.index].label;
    checkNamed(!writes(after), "the output '{}' to be only read after the frame", label);
    for (Output& output : outputs_) {
        if (output.resource != handle.index)
            continue;
        output.after |= after;
        checkNamed(hasOneLayout(output.after), "one layout for the output '{}'", label);
        return;
    }
    outputs_.push_back({handle.index, after});
}

std::span<const Access> FrameGraph::accesses(const PassNode& pass) const
{
    return std::span{accesses_}.subspan(pass.firstAccess, pass.accessCount);
}

uvec2 FrameGraph::extent(ImageRef image) const
{
    check(image.index < resources_.size(), "an image of this frame");
    return resources_[image.index].image.extent;
}

Handle FrameGraph::addResource(const Resource& resource)
{
    resources_.push_back(resource);
    const auto index = static_cast<uint32_t>(resources_.size() - 1);
    resources_[index].version = versionCount_++;
    return newest(index);
}

Handle FrameGraph::addImage(std::string_view label, const ImageDesc& desc, Origin origin)
{
    Resource resource{.label = label, .kind = Kind::Image, .origin = origin, .image = desc};
    if (desc.like)
        resource.image.extent = scaled(extent(desc.like), desc.scale);
    resource.bytes = estimatedBytes(resource.image);
    checkNamed(resource.bytes > 0, "a format and an extent for the image '{}'", label);
    return addResource(resource);
}

Handle FrameGraph::addBuffer(std::string_view label, uint64_t bytes, Origin origin)
{
    checkNamed(bytes > 0, "a size for the buffer '{}'", label);
    return addResource({.label = label, .kind = Kind::Buffer, .origin = origin, .bytes = bytes});
}

Handle FrameGraph::read(uint32_t pass, Handle handle, Use use)
{
    checkNewest(handle, passes_[pass].name);
    const Resource& resource = resources_[handle.index];
    checkNamed(hasContents(resource), "'{}' to be written before pass '{}' reads it", resource.label, passes_[pass].name);
    addAccess(pass, {.resource = handle.index, .before = resource.version, .use = use});
    return handle;
}

Handle FrameGraph::write(uint32_t pass, Handle handle, Use use)
{
    checkNewest(handle, passes_[pass].name);
    Resource& resource = resources_[handle.index];
    resource.written = true;
    const uint32_t before = std::exchange(resource.version, versionCount_++);
    addAccess(pass, {.resource = handle.index, .before = before, .after = resource.version, .use = use});
    return newest(handle.index);
}

Handle FrameGraph::create(uint32_t pass, Handle handle, Use use)
{
    Resource& resource = resources_[handle.index];
    checkNamed(!resource.image.clear || isAttachment(use), "'{}' to be an attachment, since it is cleared", resource.label);
    resource.written = true;
    addAccess(pass, {.resource = handle.index, .after = resource.version, .use = use});
    return handle;
}

void FrameGraph::addAccess(uint32_t pass, const Access& access)
{
    PassNode& node = passes_[pass];
    const std::string_view label = resources_[access.resource].label;
    const Kind kind = resources_[access.resource].kind;
    const bool isRead = access.after == kNone;
    checkNamed(pass + 1 == passes_.size(), "pass '{}' to be declared whole before the next is added", node.name);
    checkNamed(kind == Kind::Image ? suitsImages(access.use) : suitsBuffers(access.use), "a use that '{}' can have, not {}", label,
               nameOf(access.use));
    checkNamed(isRead != writes(access.use), "pass '{}' to {} '{}', not as {}", node.name, isRead ? "read" : "write", label,
               nameOf(access.use));
    for (const Access& other : accesses(node)) {
        if (other.resource != access.resource)
            continue;
        checkNamed(other.after == kNone, "pass '{}' to be done with '{}' once it has written it", node.name, label);
        checkNamed(kind == Kind::Buffer || layoutOf(other.use) == layoutOf(access.use), "one layout for '{}' in pass '{}'", label,
                   node.name);
    }
    accesses_.push_back(access);
    ++node.accessCount;
}

Handle FrameGraph::newest(uint32_t resource) const { return {resource, firstVersion_ + resources_[resource].version}; }

void FrameGraph::checkNewest(Handle handle, std::string_view user) const
{
    checkNamed(handle.index < resources_.size() && handle.version >= firstVersion_, "a handle of this frame in '{}'", user);
    checkNamed(handle == newest(handle.index), "the newest version of '{}' in '{}'", resources_[handle.index].label, user);
}

} // namespace antumbra::graph
