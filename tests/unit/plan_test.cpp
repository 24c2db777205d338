#include "graph/plan.h"
#include "tests/unit/allocation_counter.h"

#include <gtest/gtest.h>

namespace antumbra::graph {
namespace {

constexpr ImageDesc kImage{.format = gpu::Format::Rgba16Float, .extent = {64, 32}};
constexpr ImageDesc kDepth{.format = gpu::Format::Depth32Float, .extent = {64, 32}};

std::vector<std::string_view> stepNames(const FrameGraph& graph)
{
    std::vector<std::string_view> names;
    for (const Step& step : compile(graph).steps)
        names.push_back(graph.passes()[step.pass].name);
    return names;
}

std::span<const Barrier> barriersBefore(const Plan& plan, size_t step) { return plan.barriersOf(plan.steps[step].barriers); }

/// A pass that reads and survives.
void observe(FrameGraph& graph, std::string_view name, ImageRef image, Use use) { graph.add(name).sideEffect().read(image, use); }

using Names = std::vector<std::string_view>;

TEST(PlanCulling, APassThatNothingReadsDoesNotRun)
{
    FrameGraph graph;
    const ImageRef seen = graph.add("seen").create("seen image", kImage, Use::StorageWrite);
    std::ignore = graph.add("unseen").create("unseen image", kImage, Use::StorageWrite);
    graph.output(seen);
    EXPECT_EQ(stepNames(graph), Names{"seen"});

    const Plan plan = compile(graph);
    ASSERT_EQ(plan.absent.size(), 1u);
    EXPECT_EQ(plan.absent[0].name, "unseen");
    EXPECT_EQ(reasonOf(plan.absent[0]), "nothing reads 'unseen image'");
    EXPECT_EQ(plan.transients, std::vector{seen.index});
}

TEST(PlanCulling, WhatOnlyCulledPassesReadIsCulledToo)
{
    FrameGraph graph;
    const ImageRef traced = graph.add("trace").create("traced", kImage, Use::StorageWrite);
    Pass filter = graph.add("filter");
    filter.read(traced, Use::Sampled);
    std::ignore = filter.create("filtered", kImage, Use::StorageWrite);
    EXPECT_EQ(stepNames(graph), Names{});
    EXPECT_EQ(compile(graph).absent.size(), 2u);
}

TEST(PlanCulling, SideEffectsKeepAPassAndWhatItNeeds)
{
    FrameGraph graph;
    const ImageRef traced = graph.add("trace").create("traced", kImage, Use::StorageWrite);
    observe(graph, "read back", traced, Use::TransferRead);
    EXPECT_EQ(stepNames(graph), (Names{"trace", "read back"}));
}

TEST(PlanCulling, AWriteNeedsTheVersionItRetires)
{
    FrameGraph graph;
    const ImageRef drawn = graph.add("draw").create("color", kImage, Use::ColorAttachment);
    graph.output(graph.add("blend").write(drawn, Use::ColorAttachment));
    EXPECT_EQ(stepNames(graph), (Names{"draw", "blend"}));
}

TEST(PlanCulling, AWriteAfterTheLastReadIsCulled)
{
    FrameGraph graph;
    const ImageRef drawn = graph.add("draw").create("color", kImage, Use::ColorAttachment);
    observe(graph, "show", drawn, Use::Sampled);
    std::ignore = graph.add("too late").write(drawn, Use::ColorAttachment);
    EXPECT_EQ(stepNames(graph), (Names{"draw", "show"}));
}

TEST(PlanCulling, SkippedPassesKeepTheirReason)
{
    FrameGraph graph;
    graph.skip("sdf shadow", "no SDFPrimitive");
    const Plan plan = compile(graph);
    ASSERT_EQ(plan.absent.size(), 1u);
    EXPECT_EQ(plan.absent[0].name, "sdf shadow");
    EXPECT_EQ(reasonOf(plan.absent[0]), "no SDFPrimitive");
}

TEST(PlanBarriers, AReadWaitsForTheWrite)
{
    FrameGraph graph;
    const ImageRef image = graph.add("write").create("image", kImage, Use::StorageWrite);
    observe(graph, "read", image, Use::Sampled);
    const Plan plan = compile(graph);
    ASSERT_EQ(barriersBefore(plan, 1).size(), 1u);
    EXPECT_EQ(barriersBefore(plan, 1)[0], (Barrier{image.index, Use::StorageWrite, Use::Sampled, false}));
}

TEST(PlanBarriers, ReadsInARowShareTheFirstOnesBarrier)
{
    FrameGraph graph;
    const ImageRef depth = graph.add("draw").create("depth", kDepth, Use::DepthAttachment);
    const BufferRef buffer = graph.add("fill").createBuffer("arguments", 64, Use::StorageWrite);
    Pass first = graph.add("first");
    first.sideEffect().read(depth, Use::Sampled);
    first.read(buffer, Use::Indirect);
    Pass second = graph.add("second");
    second.sideEffect().read(depth, Use::DepthRead);
    second.read(buffer, Use::TransferRead);

    const Plan plan = compile(graph);
    ASSERT_EQ(barriersBefore(plan, 2).size(), 2u);
    EXPECT_EQ(barriersBefore(plan, 2)[0].to, Use::Sampled | Use::DepthRead);
    EXPECT_EQ(barriersBefore(plan, 2)[1].to, Use::Indirect | Use::TransferRead);
    EXPECT_TRUE(barriersBefore(plan, 3).empty());
}

TEST(PlanBarriers, AnotherLayoutNeedsABarrierBetweenReads)
{
    FrameGraph graph;
    const ImageRef image = graph.add("write").create("image", kImage, Use::StorageWrite);
    observe(graph, "sample", image, Use::Sampled);
    observe(graph, "load", image, Use::StorageRead);
    const Plan plan = compile(graph);
    ASSERT_EQ(barriersBefore(plan, 2).size(), 1u);
    EXPECT_EQ(barriersBefore(plan, 2)[0], (Barrier{image.index, Use::Sampled, Use::StorageRead, false}));
}

TEST(PlanBarriers, AWriteWaitsForAllReadsAndForTheWriteBefore)
{
    FrameGraph graph;
    BufferRef buffer = graph.add("make").createBuffer("buffer", 64, Use::StorageWrite);
    graph.add("one").sideEffect().read(buffer, Use::VertexRead);
    graph.add("two").sideEffect().read(buffer, Use::AccelBuildInput);
    buffer = graph.add("write").write(buffer, Use::StorageWrite);
    buffer = graph.add("again").write(buffer, Use::StorageWrite);
    graph.output(buffer, Use::HostRead);
    const Plan plan = compile(graph);
    EXPECT_EQ(barriersBefore(plan, 3)[0].from, Use::VertexRead | Use::AccelBuildInput);
    EXPECT_EQ(barriersBefore(plan, 4)[0], (Barrier{buffer.index, Use::StorageWrite, Use::StorageWrite, false}));
    ASSERT_EQ(plan.barriersOf(plan.finalBarriers).size(), 1u);
    EXPECT_EQ(plan.barriersOf(plan.finalBarriers)[0].to, UseSet{Use::HostRead});
    EXPECT_EQ(plan.resources[buffer.index].left, UseSet{Use::HostRead});
}

TEST(PlanBarriers, ImportsStartFromTheStateTheyAreSaidToHave)
{
    FrameGraph graph;
    const ImageRef map = graph.import("map", kImage, ImportedImage{1}, Use::Sampled);
    const ImageRef sum = graph.import("sum", kImage, ImportedImage{2}, Use::StorageWrite);
    const ImageRef window = graph.import("window", kImage, ImportedImage{3}, {});
    const BufferRef bones = graph.importBuffer("bones", 64);
    Pass pass = graph.add("pass");
    pass.read(map, Use::Sampled);
    pass.read(sum, Use::StorageRead);
    pass.read(bones, Use::StorageRead);
    graph.output(pass.write(window, Use::ColorAttachment), Use::Present);

    const Plan plan = compile(graph);
    ASSERT_EQ(barriersBefore(plan, 0).size(), 3u);
    EXPECT_EQ(barriersBefore(plan, 0)[0], (Barrier{sum.index, Use::StorageWrite, Use::StorageRead, false}));
    EXPECT_EQ(barriersBefore(plan, 0)[1], (Barrier{bones.index, {}, Use::StorageRead, false}));
    EXPECT_EQ(barriersBefore(plan, 0)[2], (Barrier{window.index, {}, Use::ColorAttachment, true}));
    ASSERT_EQ(plan.barriersOf(plan.finalBarriers).size(), 1u);
    EXPECT_EQ(plan.barriersOf(plan.finalBarriers)[0], (Barrier{window.index, Use::ColorAttachment, Use::Present, false}));
}

TEST(PlanBarriers, AnImportThatNothingTouchesIsLeftAsItWas)
{
    FrameGraph graph;
    const ImageRef map = graph.import("map", kImage, ImportedImage{1}, Use::Sampled);
    EXPECT_EQ(compile(graph).resources[map.index].left, UseSet{Use::Sampled});
}

TEST(PlanAttachments, AreClearedOnceAndStoredWhileNeeded)
{
    FrameGraph graph;
    ImageDesc cleared = kDepth;
    cleared.clear = vec4{0};
    Pass draw = graph.add("draw");
    ImageRef color = draw.create("color", kImage, Use::ColorAttachment);
    const ImageRef depth = draw.create("depth", cleared, Use::DepthAttachment);
    Pass sky = graph.add("sky");
    sky.read(depth, Use::DepthRead);
    color = sky.write(color, Use::ColorAttachment);
    graph.output(color);

    const Plan plan = compile(graph);
    const auto first = plan.attachmentsOf(plan.steps[0]);
    ASSERT_EQ(first.size(), 2u);
    EXPECT_EQ(first[0], (Attachment{color.index, Use::ColorAttachment, Load::Discard, true}));
    EXPECT_EQ(first[1], (Attachment{depth.index, Use::DepthAttachment, Load::Clear, true}));
    const auto second = plan.attachmentsOf(plan.steps[1]);
    ASSERT_EQ(second.size(), 2u);
    EXPECT_EQ(second[0], (Attachment{depth.index, Use::DepthRead, Load::Keep, false}));
    EXPECT_EQ(second[1], (Attachment{color.index, Use::ColorAttachment, Load::Keep, true}));
}

TEST(PlanAttachments, AClearedImportLosesWhatItHeld)
{
    FrameGraph graph;
    ImageDesc cleared = kImage;
    cleared.clear = vec4{0};
    const ImageRef sum = graph.import("sum", cleared, ImportedImage{1}, Use::Sampled);
    graph.output(graph.add("draw").write(sum, Use::ColorAttachment));
    const Plan plan = compile(graph);
    EXPECT_EQ(barriersBefore(plan, 0)[0], (Barrier{sum.index, Use::Sampled, Use::ColorAttachment, true}));
    EXPECT_EQ(plan.attachmentsOf(plan.steps[0])[0].load, Load::Clear);
}

TEST(PlanMemory, IsSharedByImagesThatDoNotLiveAtTheSameTime)
{
    FrameGraph graph;
    ImageRef image = graph.add("first").create("0", kImage, Use::StorageWrite);
    std::vector<ImageRef> images{image};
    for (const std::string_view label : {"1", "2", "3", "4"}) {
        Pass pass = graph.add("next");
        pass.read(image, Use::Sampled);
        images.push_back(image = pass.create(label, kImage, Use::StorageWrite));
    }
    graph.output(image);

    const Plan plan = compile(graph);
    EXPECT_EQ(plan.memory.size(), 2u);
    for (size_t i = 2; i < images.size(); ++i)
        EXPECT_EQ(plan.resources[images[i].index].memory, plan.resources[images[i - 2].index].memory);
    // The third image waits for the reads of the first, whose memory it takes.
    EXPECT_EQ(barriersBefore(plan, 2)[1], (Barrier{images[2].index, Use::Sampled, Use::StorageWrite, true}));
    EXPECT_EQ(barriersBefore(plan, 0)[0], (Barrier{images[0].index, {}, Use::StorageWrite, true}));
}

TEST(PlanMemory, IsNotSharedBetweenImagesAndBuffers)
{
    FrameGraph graph;
    observe(graph, "see", graph.add("draw").create("image", kImage, Use::StorageWrite), Use::Sampled);
    graph.output(graph.add("fill").createBuffer("buffer", 64, Use::StorageWrite));
    EXPECT_EQ(compile(graph).memory.size(), 2u);
}

TEST(PlanMemory, OfAnOutputIsNotGivenAway)
{
    FrameGraph graph;
    const ImageRef kept = graph.add("make").create("kept", kImage, Use::StorageWrite);
    const ImageRef other = graph.add("later").sideEffect().create("other", kImage, Use::StorageWrite);
    graph.output(kept);
    const Plan plan = compile(graph);
    EXPECT_NE(plan.resources[kept.index].memory, plan.resources[other.index].memory);
}

TEST(PlanHistory, IsKeptAndLeftReadyForTheNextFrame)
{
    FrameGraph graph;
    HistorySlot slot;
    for (int frame = 0; frame < 2; ++frame) {
        graph.reset();
        const History sum = graph.history("sum", kImage, slot);
        Pass pass = graph.add("accumulate");
        pass.read(sum.before, Use::Sampled);
        std::ignore = pass.write(sum.now, Use::StorageWrite);

        const Plan plan = compile(graph);
        ASSERT_EQ(plan.steps.size(), 1u);
        EXPECT_EQ(barriersBefore(plan, 0).size(), frame == 0 ? 2u : 1u) << "in the second frame `before` is at rest";
        EXPECT_EQ(barriersBefore(plan, 0).back(), (Barrier{sum.now.index, {}, Use::StorageWrite, true}));
        ASSERT_EQ(plan.barriersOf(plan.finalBarriers).size(), 1u);
        EXPECT_EQ(plan.barriersOf(plan.finalBarriers)[0], (Barrier{sum.now.index, Use::StorageWrite, kHistoryAtRest, false}));
        EXPECT_EQ(plan.resources[sum.before.index].uses, Use::Sampled | Use::StorageWrite);
        EXPECT_TRUE(plan.transients.empty());
    }
}

TEST(PlanHistoryDeath, MustBeWritten)
{
    FrameGraph graph;
    HistorySlot slot;
    graph.history("sum", kImage, slot);
    EXPECT_DEATH(compile(graph), "the history 'sum' to be written");
}

/// A frame of some twenty resources that reads, writes, shares memory, and keeps a history.
void declareFrame(FrameGraph& graph, HistorySlot& slot)
{
    const History sum = graph.history("sum", kImage, slot);
    const BufferRef bones = graph.importBuffer("bones", 4096);
    ImageRef image = graph.add("first").create("image", kImage, Use::StorageWrite);
    for (int i = 0; i < 16; ++i) {
        Pass pass = graph.add("next");
        pass.read(image, Use::Sampled);
        pass.read(bones, Use::VertexRead);
        image = pass.create("image", kImage, i % 2 == 0 ? Use::ColorAttachment : Use::StorageWrite);
        pass.record([image](Recorder&) {});
        graph.skip("other", "not needed");
    }
    Pass pass = graph.add("accumulate");
    pass.read(image, Use::Sampled);
    pass.read(sum.before, Use::Sampled);
    graph.output(pass.write(sum.now, Use::StorageWrite));
    std::ignore = graph.add("unread").create("unread", kImage, Use::StorageWrite);
}

TEST(Plan, IsAFunctionOfTheDeclaration)
{
    FrameGraph graph;
    HistorySlot slot;
    declareFrame(graph, slot);
    const Plan plan = compile(graph);
    EXPECT_EQ(plan.steps.size(), 18u);
    EXPECT_EQ(compile(graph), plan);

    Plan used;
    FrameGraph other;
    observe(other, "see", other.add("draw").create("image", kImage, Use::StorageWrite), Use::Sampled);
    compile(other, used);
    EXPECT_NE(used, plan);
    compile(graph, used);
    EXPECT_EQ(used, plan);
}

TEST(Plan, SteadyFramesAllocateNothing)
{
    FrameGraph graph;
    HistorySlot slot;
    Plan plan;
    const auto frame = [&] {
        graph.reset();
        declareFrame(graph, slot);
        compile(graph, plan);
    };
    frame();
    frame(); // the history is valid from here on
    const uint64_t before = test::allocationCount();
    for (int i = 0; i < 300; ++i)
        frame();
    EXPECT_EQ(test::allocationCount(), before);
}

} // namespace
} // namespace antumbra::graph
