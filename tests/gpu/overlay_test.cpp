#include "render/overlay.h"

#include "base/error.h"
#include "graph/executor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <memory>
#include <optional>

namespace antumbra::render {
namespace {

using graph::Use;

constexpr uvec2 kExtent{96, 64};
const vec4 kBackground{0.2f, 0.4f, 0.6f, 1.0f};

ImU32 packed(uvec4 color) { return color.x | color.y << 8 | color.z << 16 | color.w << 24; }

// A picture of one colour, the overlay above it, and a copy that the test reads.
class OverlayTest : public testing::Test
{
protected:
    void SetUp() override
    {
        try {
            device_ = std::make_unique<gpu::Device>(gpu::DeviceOptions{.validation = true});
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        overlay_.emplace(*device_);
        executor_.emplace(*device_);
        copy_ = gpu::Buffer(*device_, "copy", size_t{4} * kExtent.x * kExtent.y, gpu::MemoryKind::Readback);
    }
    void TearDown() override
    {
        if (device_) {
            EXPECT_THAT(device_->validationMessages(), testing::IsEmpty());
        }
    }

    void renderFrame()
    {
        const VkCommandBuffer commands = device_->beginFrame();
        graph_.reset();
        graph::Pass blank = graph_.add("blank");
        const graph::ImageRef background =
            blank.create("picture", {.format = gpu::Format::Rgba8Unorm, .extent = kExtent, .clear = kBackground}, Use::ColorAttachment);
        const graph::ImageRef picture = overlay_->declare(graph_, background);

        const graph::BufferRef imported = graph_.importBuffer("copy", copy_.bytes(), graph::importedBuffer(copy_));
        graph::Pass copying = graph_.add("copy");
        copying.read(picture, Use::TransferRead);
        const graph::BufferRef copied = copying.write(imported, Use::TransferWrite);
        copying.record([this, picture](graph::Recorder& cmd) {
            const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                           .imageExtent = {kExtent.x, kExtent.y, 1}};
            vkCmdCopyImageToBuffer(cmd.commands(), cmd.image(picture).handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, copy_.handle(), 1,
                                   &region);
        });
        graph_.output(copied, Use::HostRead);
        compile(graph_, plan_);
        executor_->execute(plan_, graph_, commands);
        device_->endFrame(VK_NULL_HANDLE, VK_NULL_HANDLE);
        device_->waitIdle();
    }

    /// What `draw` puts on ImGui's lists, over the background.
    template <class Draw>
    void renderOverlay(Draw draw)
    {
        overlay_->begin(kExtent, 1.0f / 60);
        draw();
        overlay_->end();
        renderFrame();
    }

    [[nodiscard]] uvec4 pixel(uint32_t x, uint32_t y) const
    {
        const std::byte* bytes = copy_.mapped() + size_t{4} * (size_t{y} * kExtent.x + x);
        const auto channel = [bytes](size_t i) { return std::to_integer<uint32_t>(bytes[i]); };
        return {channel(0), channel(1), channel(2), channel(3)};
    }

    std::unique_ptr<gpu::Device> device_;
    std::optional<Overlay> overlay_;
    std::optional<graph::Executor> executor_;
    gpu::Buffer copy_;
    graph::FrameGraph graph_;
    graph::Plan plan_;
};

constexpr uvec4 kBackgroundPixel{51, 102, 153, 255};
constexpr uvec4 kGreen{10, 200, 30, 255};
constexpr uvec4 kRed{220, 20, 40, 255};

TEST_F(OverlayTest, FillsExactlyTheRectangleAsked)
{
    renderOverlay([] { ImGui::GetBackgroundDrawList()->AddRectFilled({8, 16}, {24, 40}, packed(kGreen)); });
    for (uint32_t y = 0; y < kExtent.y; ++y)
        for (uint32_t x = 0; x < kExtent.x; ++x) {
            const bool isInside = x >= 8 && x < 24 && y >= 16 && y < 40;
            ASSERT_EQ(pixel(x, y), isInside ? kGreen : kBackgroundPixel) << x << ' ' << y;
        }
}

TEST_F(OverlayTest, BlendsInDisplayValuesAndKeepsThePictureOpaque)
{
    renderOverlay([] { ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, {96, 64}, packed({255, 0, 0, 51})); });
    const uvec4 blended = pixel(48, 32);
    EXPECT_NEAR(blended.x, 0.8 * 51 + 0.2 * 255, 1);
    EXPECT_NEAR(blended.y, 0.8 * 102, 1);
    EXPECT_NEAR(blended.z, 0.8 * 153, 1);
    EXPECT_EQ(blended.w, 255u);
}

TEST_F(OverlayTest, DrawsEveryListWithinItsClipRectangle)
{
    renderOverlay([] {
        ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, {96, 64}, packed(kGreen));
        ImDrawList& front = *ImGui::GetForegroundDrawList();
        front.PushClipRect({-20, 8}, {40, 24});
        front.AddRectFilled({0, 0}, {96, 64}, packed(kRed));
        front.PopClipRect();
        front.PushClipRect({60, 40}, {500, 500});
        front.AddRectFilled({0, 0}, {96, 64}, packed(kRed));
        front.PopClipRect();
    });
    EXPECT_EQ(pixel(0, 8), kRed);
    EXPECT_EQ(pixel(39, 23), kRed);
    EXPECT_EQ(pixel(40, 23), kGreen);
    EXPECT_EQ(pixel(39, 24), kGreen);
    EXPECT_EQ(pixel(60, 40), kRed);
    EXPECT_EQ(pixel(95, 63), kRed);
    EXPECT_EQ(pixel(59, 40), kGreen);
}

TEST_F(OverlayTest, WritesText)
{
    renderOverlay([] { ImGui::GetBackgroundDrawList()->AddText({10, 10}, packed({255, 255, 255, 255}), "L"); });
    const ImFont& font = *ImGui::GetIO().Fonts->Fonts[0];
    const ImFontGlyph& glyph = *font.FindGlyph('L');
    uint32_t inside = 0, outside = 0;
    for (uint32_t y = 0; y < kExtent.y; ++y)
        for (uint32_t x = 0; x < kExtent.x; ++x) {
            const vec2 place = vec2(x, y) + 0.5f - 10.0f;
            const bool isInGlyph = place.x > glyph.X0 && place.x < glyph.X1 && place.y > glyph.Y0 && place.y < glyph.Y1;
            (isInGlyph ? inside : outside) += pixel(x, y) != kBackgroundPixel;
        }
    EXPECT_GE(inside, 10u); // a stem and a foot, one pixel wide
    EXPECT_LT(inside, static_cast<uint32_t>((glyph.X1 - glyph.X0) * (glyph.Y1 - glyph.Y0)));
    EXPECT_EQ(outside, 0u);
}

TEST_F(OverlayTest, DrawsWhatWasBuiltOnceOnly)
{
    renderOverlay([] { ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, {96, 64}, packed(kGreen)); });
    EXPECT_EQ(pixel(48, 32), kGreen);
    renderFrame();
    EXPECT_EQ(pixel(48, 32), kBackgroundPixel);
    ASSERT_EQ(plan_.absent.size(), 1u);
    EXPECT_EQ(plan_.absent[0].name, "overlay");
    EXPECT_EQ(plan_.absent[0].reason, "nothing to show");
}

TEST_F(OverlayTest, TakesNothingFromTheDeviceWhileThereIsNothingToShow)
{
    renderFrame();
    renderFrame();
    const uint64_t before = device_->memory().stats().allocationsEver;
    renderOverlay([] {});
    EXPECT_EQ(device_->memory().stats().allocationsEver, before);
}

TEST_F(OverlayTest, SteadyFramesTakeNothingFromTheDevice)
{
    const auto draw = [] {
        for (int i = 0; i < 2000; ++i)
            ImGui::GetBackgroundDrawList()->AddRectFilled({8, 16}, {24, 40}, packed(kGreen));
    };
    for (int frame = 0; frame < 6; ++frame)
        renderOverlay(draw);
    const uint64_t before = device_->memory().stats().allocationsEver;
    for (int frame = 0; frame < 20; ++frame)
        renderOverlay(draw);
    EXPECT_EQ(device_->memory().stats().allocationsEver, before);
}

} // namespace
} // namespace antumbra::render
