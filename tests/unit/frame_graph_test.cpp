#include "graph/frame_graph.h"

#include <gtest/gtest.h>

#include <memory>

namespace antumbra::graph {

namespace {

constexpr ImageDesc kSmall{.format = gpu::Format::Rgba16Float, .extent = {64, 32}};

TEST(FrameGraph, WritingMakesANewVersion)
{
    FrameGraph graph;
    const ImageRef first = graph.add("draw").create("color", kSmall, Use::ColorAttachment);
    const ImageRef second = graph.add("blend").write(first, Use::ColorAttachment);
    EXPECT_EQ(first.index, second.index);
    EXPECT_NE(first.version, second.version);
    EXPECT_EQ(graph.add("show").read(second, Use::Sampled), second);
}

TEST(FrameGraph, AnImageIsSizedAfterAnother)
{
    FrameGraph graph;
    Pass pass = graph.add("pass");
    const ImageRef whole = pass.create("whole", {.format = gpu::Format::R16Float, .extent = {65, 1}}, Use::StorageWrite);
    const ImageRef half = pass.create("half", {.format = gpu::Format::R16Float, .like = whole, .scale = 0.5f}, Use::StorageWrite);
    EXPECT_EQ(graph.extent(half), uvec2(33, 1));
    EXPECT_EQ(graph.resources()[half.index].bytes, 66u);
}

TEST(FrameGraph, APassMayReadAResourceInSeveralUsesOfOneLayout)
{
    FrameGraph graph;
    const ImageRef depth = graph.add("draw").create("depth", {.format = gpu::Format::Depth32Float, .extent = {8, 8}}, Use::DepthAttachment);
    Pass sky = graph.add("sky");
    sky.read(depth, Use::DepthRead);
    sky.read(depth, Use::Sampled);
    EXPECT_EQ(graph.accesses(graph.passes()[1]).size(), 2u);
}

TEST(FrameGraph, CommandsAreKeptUntilTheFrameIsOver)
{
    FrameGraph graph;
    const auto captured = std::make_shared<int>(3);
    graph.add("pass").record([captured](Recorder&) {});
    graph.add("another");
    EXPECT_TRUE(graph.passes()[0].commands);
    EXPECT_FALSE(graph.passes()[1].commands);
    EXPECT_EQ(captured.use_count(), 2);
    graph.reset();
    EXPECT_EQ(captured.use_count(), 1);
}

TEST(FrameGraph, HistoryImagesChangePlacesAndAreValidFromTheSecondFrame)
{
    FrameGraph graph;
    HistorySlot slot;
    uint64_t writtenBefore = 0;
    for (int frame = 0; frame < 4; ++frame) {
        const auto [before, now, valid] = graph.history("sum", kSmall, slot);
        EXPECT_EQ(valid, frame > 0);
        const uint64_t written = graph.resources()[now.index].token;
        EXPECT_NE(written, graph.resources()[before.index].token);
        if (frame > 0) {
            EXPECT_EQ(graph.resources()[before.index].token, writtenBefore);
        }
        writtenBefore = written;
        graph.reset();
    }
}

TEST(FrameGraph, HistoryIsInvalidAfterAGapAndAfterAResize)
{
    FrameGraph graph;
    HistorySlot slot;
    const auto isValid = [&](uvec2 extent) {
        const bool valid = graph.history("sum", {.format = gpu::Format::R32Float, .extent = extent}, slot).valid;
        graph.reset();
        return valid;
    };
    EXPECT_FALSE(isValid({4, 4}));
    EXPECT_TRUE(isValid({4, 4}));
    EXPECT_FALSE(isValid({8, 4}));
    EXPECT_TRUE(isValid({8, 4}));
    graph.reset();
    EXPECT_FALSE(isValid({8, 4}));
}

TEST(FrameGraph, TwoHistoriesNeverShareAnImage)
{
    FrameGraph graph;
    HistorySlot a;
    HistorySlot b;
    graph.history("a", kSmall, a);
    graph.history("b", kSmall, b);
    EXPECT_NE(a.id, b.id);
}

TEST(FrameGraphDeath, AStaleVersionIsNamed)
{
    FrameGraph graph;
    const ImageRef first = graph.add("draw").create("albedo", kSmall, Use::ColorAttachment);
    std::ignore = graph.add("blend").write(first, Use::ColorAttachment);
    EXPECT_DEATH(graph.add("late").read(first, Use::Sampled), "newest version of 'albedo' in 'late'");
    EXPECT_DEATH(std::ignore = graph.add("late").write(first, Use::StorageWrite), "newest version of 'albedo' in 'late'");
    EXPECT_DEATH(graph.output(first), "newest version of 'albedo' in 'an output'");
}

TEST(FrameGraphDeath, AHandleOfAnEarlierFrameIsStale)
{
    FrameGraph graph;
    const ImageRef kept = graph.add("draw").create("albedo", kSmall, Use::ColorAttachment);
    graph.reset();
    std::ignore = graph.add("draw").create("albedo", kSmall, Use::ColorAttachment);
    EXPECT_DEATH(graph.add("late").read(kept, Use::Sampled), "a handle of this frame in 'late'");
    EXPECT_DEATH(graph.add("late").read(ImageRef{}, Use::Sampled), "a handle of this frame in 'late'");
}

TEST(FrameGraphDeath, UsesThatDoNotFitAreNamed)
{
    FrameGraph graph;
    Pass pass = graph.add("pass");
    const ImageRef image = graph.import("picture", kSmall, ImportedImage{1}, Use::Sampled);
    const BufferRef buffer = graph.importBuffer("bones", 64);
    EXPECT_DEATH(pass.read(image, Use::StorageWrite), "pass 'pass' to read 'picture', not as storage write");
    EXPECT_DEATH(std::ignore = pass.write(image, Use::Sampled), "pass 'pass' to write 'picture', not as sampled");
    EXPECT_DEATH(pass.read(image, Use::VertexRead), "a use that 'picture' can have");
    EXPECT_DEATH(pass.read(buffer, Use::Sampled), "a use that 'bones' can have");
    pass.read(image, Use::Sampled);
    EXPECT_DEATH(pass.read(image, Use::StorageRead), "one layout for 'picture' in pass 'pass'");
}

TEST(FrameGraphDeath, APassDoesNotReadWhatItMakes)
{
    FrameGraph graph;
    Pass pass = graph.add("pass");
    const ImageRef made = pass.create("made", kSmall, Use::StorageWrite);
    EXPECT_DEATH(pass.read(made, Use::StorageRead), "done with 'made' once it has written it");
    EXPECT_DEATH(std::ignore = pass.write(made, Use::StorageWrite), "done with 'made' once it has written it");
}

TEST(FrameGraphDeath, APassIsDeclaredWholeBeforeTheNext)
{
    FrameGraph graph;
    Pass early = graph.add("early");
    const ImageRef later = graph.add("later").create("later image", kSmall, Use::StorageWrite);
    EXPECT_DEATH(early.read(later, Use::Sampled), "'early' to be declared whole");
}

TEST(FrameGraphDeath, UndefinedContentsAreNotRead)
{
    FrameGraph graph;
    HistorySlot slot;
    const History sum = graph.history("sum", kSmall, slot);
    const ImageRef target = graph.import("target", kSmall, ImportedImage{1}, {});
    Pass pass = graph.add("pass");
    EXPECT_DEATH(pass.read(sum.now, Use::Sampled), "'sum' to be written before pass 'pass' reads it");
    EXPECT_DEATH(pass.read(target, Use::Sampled), "'target' to be written before pass 'pass' reads it");
}

TEST(FrameGraphDeath, MistakenDescriptionsAreNamed)
{
    FrameGraph graph;
    HistorySlot slot;
    graph.history("sum", kSmall, slot);
    EXPECT_DEATH(graph.history("sum", kSmall, slot), "the history 'sum' to be declared once a frame");
    Pass pass = graph.add("pass");
    EXPECT_DEATH(std::ignore = pass.create("empty", {.format = gpu::Format::R32Float}, Use::StorageWrite),
                 "a format and an extent.*'empty'");
    EXPECT_DEATH(std::ignore = pass.createBuffer("none", 0, Use::StorageWrite), "a size for the buffer 'none'");
    const ImageDesc cleared{.format = gpu::Format::R32Float, .extent = {1, 1}, .clear = vec4{0}};
    EXPECT_DEATH(std::ignore = pass.create("sums", cleared, Use::StorageWrite), "'sums' to be an attachment");
}

} // namespace
} // namespace antumbra::graph
