// Runs a plan on the device: memory for transients and histories, the barriers, attachments, labels and timers around each pass.
// Decides nothing: what runs and in which order is the plan's.
#pragma once

#include "gpu/image.h"
#include "gpu/pipeline.h"
#include "gpu/timers.h"
#include "graph/plan.h"

#include <deque>
#include <optional>
#include <string_view>
#include <vector>

namespace antumbra::graph {

inline ImportedImage importedImage(const gpu::Image& image) { return static_cast<ImportedImage>(reinterpret_cast<uint64_t>(&image)); }
inline ImportedBuffer importedBuffer(const gpu::Buffer& buffer) { return static_cast<ImportedBuffer>(reinterpret_cast<uint64_t>(&buffer)); }

enum class Faces { Both, Front, FrontMirrored };

/// What a pass records into. Slots, addresses and extents of the handles it declared; pipelines with their push constants.
class Recorder
{
public:
    [[nodiscard]] VkCommandBuffer commands() const { return commands_; }
    [[nodiscard]] const gpu::Image& image(ImageRef image) const { return *images_[image.index]; }
    [[nodiscard]] uint32_t sampled(ImageRef image) const { return images_[image.index]->sampledSlot(); }
    [[nodiscard]] uint32_t storage(ImageRef image) const { return images_[image.index]->storageSlot(); }
    [[nodiscard]] VkDeviceAddress address(BufferRef buffer) const { return buffers_[buffer.index]->address(); }
    [[nodiscard]] uvec2 extent(ImageRef image) const { return images_[image.index]->info().extent; }

    /// As many groups of `group` threads as cover `threads`.
    template <class Push>
    void dispatch(const gpu::Pipeline& pipeline, const Push& push, uvec2 threads, uvec2 group = {8, 8})
    {
        bind(pipeline, &push, sizeof(Push));
        vkCmdDispatch(commands_, (threads.x + group.x - 1) / group.x, (threads.y + group.y - 1) / group.y, 1);
    }
    template <class Push>
    void draw(const gpu::Pipeline& pipeline, const Push& push, uint32_t vertexCount)
    {
        bind(pipeline, &push, sizeof(Push));
        vkCmdDraw(commands_, vertexCount, 1, 0, 0);
    }
    template <class Push>
    void drawIndexed(const gpu::Pipeline& pipeline, const Push& push, const gpu::Buffer& indices, uint32_t indexCount, Faces faces,
                     uint32_t firstIndex = 0, VkIndexType type = VK_INDEX_TYPE_UINT32, int32_t vertexOffset = 0)
    {
        bind(pipeline, &push, sizeof(Push));
        drawBound(indices, indexCount, faces, firstIndex, type, vertexOffset);
    }
    /// Orders acceleration structure and compute work of one pass: builds that read what a dispatch of it wrote, and the like.
    void orderWithinPass() const;

private:
    friend class Executor;
    void bind(const gpu::Pipeline& pipeline, const void* push, size_t bytes);
    void drawBound(const gpu::Buffer& indices, uint32_t indexCount, Faces faces, uint32_t firstIndex, VkIndexType type,
                   int32_t vertexOffset);

    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline bound_ = VK_NULL_HANDLE;
    const gpu::Image* const* images_ = nullptr;
    const gpu::Buffer* const* buffers_ = nullptr;
};

/// The time of one pass of the newest frame that is done.
struct PassTime
{
    std::string_view name;
    std::optional<double> milliseconds; // none: the device has no timestamps
};

class Executor
{
public:
    explicit Executor(gpu::Device& device) : device_(&device), timers_(device) {}

    /// Between Device::beginFrame and endFrame; `plan` must be compiled from `graph`.
    void execute(const Plan& plan, const FrameGraph& graph, VkCommandBuffer commands);

    /// In order of execution, of the newest frame that is done.
    [[nodiscard]] const std::vector<PassTime>& passTimes() const { return done_; }
    [[nodiscard]] std::optional<double> frameMilliseconds() const { return timers_.wholeMilliseconds(); }
    /// Bytes held for transients and histories.
    [[nodiscard]] uint64_t transientBytes() const;
    [[nodiscard]] uint64_t historyBytes() const;

private:
    // A transient as it must be made; two frames whose needs are equal use the same memory.
    struct Need
    {
        Kind kind;
        gpu::ImageInfo image;
        uint64_t bytes;
        uint32_t memory;

        friend bool operator==(const Need&, const Need&) = default;
    };
    struct Realisation
    {
        std::vector<Need> needs;
        std::vector<gpu::Image> images;
        std::vector<gpu::Buffer> buffers; // one a shared memory of buffers
        std::vector<gpu::Allocation> allocations;
        uint64_t bytes = 0;
        uint64_t lastFrame = 0;
    };
    struct HistoryPair
    {
        gpu::ImageInfo info;
        gpu::Image sides[2];
    };

    void resolve(const Plan& plan, const FrameGraph& graph);
    Realisation& realise(const Plan& plan, const FrameGraph& graph);
    void make(Realisation& realisation, const Plan& plan, const FrameGraph& graph);
    void retire(Realisation& realisation);
    const gpu::Image& historySide(uint64_t token, const gpu::ImageInfo& info, std::string_view label);
    void recordBarriers(std::span<const Barrier> barriers, const FrameGraph& graph);
    void recordStep(const Plan& plan, const FrameGraph& graph, const Step& step);
    void beginAttachments(std::span<const Attachment> attachments, const FrameGraph& graph);
    [[nodiscard]] gpu::ImageInfo infoOf(const Resource& resource, UseSet uses) const;

    gpu::Device* device_;
    gpu::Timers timers_;
    Recorder recorder_;
    std::vector<Realisation> realisations_;
    std::deque<HistoryPair> histories_; // images of a frame stay where they are as others come
    std::vector<Need> needs_;
    std::vector<const gpu::Image*> images_;
    std::vector<const gpu::Buffer*> buffers_;
    std::vector<VkImageMemoryBarrier2> imageBarriers_;
    std::vector<std::string_view> names_[gpu::kFramesInFlight];
    std::vector<PassTime> done_;
};

} // namespace antumbra::graph
