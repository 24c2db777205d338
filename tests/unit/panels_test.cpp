#include "app/panels.h"

#include "app/panel_sections.h"
#include "render/overlay_style.h"
#include "tests/unit/allocation_counter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>

namespace antumbra::app {
namespace {

// Panels over a picture that nobody draws, and a mouse that the test moves.
class PanelsTest : public testing::Test
{
protected:
    PanelsTest() : context_(ImGui::CreateContext())
    {
        ImGui::SetCurrentContext(context_);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {960, 720};
        io.Fonts->Build();
        render::applyOverlayStyle(ImGui::GetStyle());
        frame();
        frame(); // windows know their size from the second on
    }
    ~PanelsTest() override { ImGui::DestroyContext(context_); }

    void frame()
    {
        profiler_.record(report_, 16.0);
        ImGui::GetIO().DeltaTime = 1.0f; // two clicks are never a double click
        ImGui::NewFrame();
        panels_.build({.device = "llvmpipe",
                       .scene = "plaza",
                       .profiler = profiler_,
                       .report = report_,
                       .memory = memory_,
                       .quality = quality_ ? &*quality_ : nullptr,
                       .keys = keys_,
                       .message = message_},
                      knobs_, splitColumn_);
        ImGui::Render();
    }

    void pointAt(float x, float y)
    {
        ImGui::GetIO().MousePos = {x, y};
        frame();
    }
    void click(float x, float y)
    {
        pointAt(x, y);
        ImGui::GetIO().MouseDown[ImGuiMouseButton_Left] = true;
        frame();
        ImGui::GetIO().MouseDown[ImGuiMouseButton_Left] = false;
        frame();
    }
    void dragRight(float fromX, float toX, float y)
    {
        pointAt(fromX, y);
        ImGui::GetIO().MouseDown[ImGuiMouseButton_Right] = true;
        frame();
        pointAt(toX, y);
        ImGui::GetIO().MouseDown[ImGuiMouseButton_Right] = false;
        frame();
    }

    /// From `left` on, all within the column of controls. An even number of clicks a row leaves headers as open as they were.
    template <class Visit>
    void clickAllOver(float left, float bottom, Visit visit)
    {
        for (int row = 2; 5 * static_cast<float>(row) < bottom; ++row)
            for (int column = 0; column < 20; ++column) {
                const float x = left + 12 * static_cast<float>(column), y = 5 * static_cast<float>(row);
                click(x, y);
                visit(x, y);
            }
    }

    static int drawnIndices() { return ImGui::GetDrawData()->TotalIdxCount; }

    std::array<graph::PassTime, 2> passes_{{{"occlusion trace", 12.5}, {"tonemap", std::nullopt}}};
    std::array<graph::AbsentPass, 2> absent_{{{"skinning", "no DynamicSkinned in view", {}}, {"upsample", {}, "occluded"}}};
    std::array<KeyHint, 2> keys_{{{"W A S D", "walk"}, {"F1", "overlay"}}};
    render::FrameReport report_{.passes = passes_, .absent = absent_, .frameMilliseconds = 14.0, .counters = {.nanPixels = 3}, .frame = 2};
    render::MemoryReport memory_{};
    render::Knobs knobs_;
    uint32_t splitColumn_ = 0;
    std::string message_;
    std::optional<QualityControl> quality_;
    Profiler profiler_;
    Panels panels_;

private:
    ImGuiContext* context_;
};

TEST_F(PanelsTest, ShowWithoutChangingAnything)
{
    EXPECT_GT(drawnIndices(), 0);
    EXPECT_EQ(splitColumn_, 0u);
    for (const render::KnobDescription& knob : render::knobTable())
        EXPECT_EQ(knob.read(knobs_), knob.read(render::Knobs{})) << knob.key;
}

TEST_F(PanelsTest, HiddenOnesDrawOnlyTheMessage)
{
    panels_.toggle();
    frame();
    EXPECT_EQ(drawnIndices(), 0);
    message_ = "shaders/tonemap.comp: ERROR: 12: syntax error";
    frame();
    frame();
    EXPECT_GT(drawnIndices(), 0);
}

TEST_F(PanelsTest, EvaluationsOfFieldsAreShownWhereThereAreAny)
{
    const int without = drawnIndices();
    report_.counters.fieldEvaluations = 12'345'678;
    frame();
    frame();
    EXPECT_GT(drawnIndices(), without);
}

TEST_F(PanelsTest, AFrameTimeToHoldHasItsLine)
{
    const int without = drawnIndices();
    quality_.emplace(20, knobs_, knobs_);
    frame();
    frame();
    EXPECT_GT(drawnIndices(), without);
}

TEST_F(PanelsTest, EveryViewHasAButton)
{
    std::set<double> seen;
    clickAllOver(704, 90, [&](float, float) { seen.insert(static_cast<double>(knobs_.view)); });
    const auto view = std::ranges::find(render::knobTable(), "view", &render::KnobDescription::key);
    EXPECT_EQ(seen.size(), view->choices.size());
}

TEST_F(PanelsTest, EveryLiveKnobIsReachedAndStaysInItsRange)
{
    std::set<std::string_view> reached;
    clickAllOver(704, 440, [&](float x, float y) {
        click(x, y + (static_cast<int>(y) % 10 == 0 ? 34.0f : 51.0f)); // into the list that a choice opens: its second or third
        for (const render::KnobDescription& knob : render::knobTable()) {
            if (knob.read(knobs_) != knob.read(render::Knobs{}))
                reached.insert(knob.key);
            EXPECT_NO_THROW(render::set(knobs_, knob.key, render::get(knobs_, knob.key)));
        }
    });
    for (const render::KnobDescription& knob : render::knobTable())
        EXPECT_EQ(reached.contains(knob.key), knob.isLive) << knob.key;
}

TEST_F(PanelsTest, TheRightButtonMovesTheSplit)
{
    dragRight(500, 533, 600);
    EXPECT_EQ(splitColumn_, 533u);
    dragRight(533, 9999, 600);
    EXPECT_EQ(splitColumn_, 960u);
}

TEST_F(PanelsTest, TheSplitStaysWhileTheMouseIsOverAPanel)
{
    splitColumn_ = 320;
    dragRight(40, 60, 40);
    EXPECT_EQ(splitColumn_, 320u);
}

TEST_F(PanelsTest, TheSplitStaysInAPictureThatShrinks)
{
    splitColumn_ = 960;
    ImGui::GetIO().DisplaySize = {320, 240};
    frame();
    EXPECT_EQ(splitColumn_, 320u);
}

TEST_F(PanelsTest, SteadyFramesAllocateNothing)
{
    splitColumn_ = 320;
    for (int i = 0; i < 80; ++i)
        frame();
    const uint64_t before = test::allocationCount();
    for (int i = 0; i < 300; ++i)
        frame();
    EXPECT_EQ(test::allocationCount(), before);
}

TEST(Snapped, ReturnsTheNearestAllowedValue)
{
    EXPECT_EQ(snapped({32, 1024, 32}, 70), 64);
    EXPECT_EQ(snapped({32, 1024, 32}, 5000), 1024);
    EXPECT_EQ(snapped({1, 200, 1}, -3), 1);
    EXPECT_EQ(snapped({0, 10, 4}, 10), 8);
    EXPECT_EQ(snapped({0, 0.1, 0}, 0.0123), 0.0123);
}

TEST(Line, CutsWhatDoesNotFit)
{
    const Line line("{:>400}", 'x');
    EXPECT_EQ(std::string_view(line).size(), 159u);
    EXPECT_STREQ(Line("{} ms", 3), "3 ms");
}

} // namespace
} // namespace antumbra::app
