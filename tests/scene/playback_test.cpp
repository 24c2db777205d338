// Scripted playback on the device: what is asked shows in the picture, and what was recorded is what was asked.
#include "app/playback.h"
#include "base/error.h"
#include "game/gameplay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace antumbra::app {
namespace {

constexpr uvec2 kSize{240, 135};

class PlaybackTest : public testing::Test
{
protected:
    void SetUp() override
    {
        try {
            device_ = std::make_unique<gpu::Device>(gpu::DeviceOptions{.validation = true});
        } catch (const Error& error) {
            ASSERT_EQ(std::getenv("ANTUMBRA_REQUIRE_DEVICE"), nullptr) << error.what();
            GTEST_SKIP() << error.what();
        }
        stage_ = std::make_unique<Stage>(findScene("plaza", {}), 1, game::addGameplay);
        playback_ =
            std::make_unique<Playback>(*device_, *stage_, PlaybackOptions{.sceneName = "plaza", .size = kSize, .isRecording = true});
        playback_->warmUp();
    }
    void TearDown() override
    {
        playback_.reset();
        if (device_) {
            EXPECT_THAT(device_->validationMessages(), testing::IsEmpty());
        }
    }

    std::vector<uint8_t> play(const ScriptStep& step, int steps = 1)
    {
        for (int i = 0; i < steps; ++i) {
            playback_->perform(step);
            playback_->draw(kStepSeconds, nullptr, nullptr);
            playback_->measure(1);
        }
        return playback_->renderer().picture().rgba;
    }
    static ScriptStep pressing(Action action)
    {
        ScriptStep step;
        step.input.ask(action);
        return step;
    }
    static ScriptStep setting(const std::string& key, const std::string& value)
    {
        ScriptStep step;
        step.settings = {{key, value}};
        return step;
    }
    /// Share of the pixels that differ by more than `threshold` of 255 in some channel.
    static double changed(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int threshold = 8)
    {
        size_t pixels = 0;
        for (size_t i = 0; i < a.size(); i += 4) {
            int greatest = 0;
            for (size_t channel = 0; channel < 3; ++channel)
                greatest = std::max(greatest, std::abs(a[i + channel] - b[i + channel]));
            pixels += greatest > threshold ? 1 : 0;
        }
        return static_cast<double>(pixels) / (static_cast<double>(a.size()) / 4);
    }

    std::unique_ptr<gpu::Device> device_;
    std::unique_ptr<Stage> stage_;
    std::unique_ptr<Playback> playback_;
};

TEST_F(PlaybackTest, WhilePausedThePictureStands)
{
    play(pressing(Action::Pause));
    const auto before = play({}, 3);
    EXPECT_EQ(play({}, 3), before);
}

TEST_F(PlaybackTest, AWalkShowsInThePicture)
{
    const auto before = play({});
    const auto after = play({.input = {.move = {1, 0}}}, 30);
    EXPECT_GT(changed(before, after), 0.02);
}

TEST_F(PlaybackTest, TurningTheLightMovesShadowsAndTurningItBackBringsThemBack)
{
    play(pressing(Action::Pause));
    const auto before = play({}, 3);
    const auto turned = play({.input = {.turnLight = 1}}, 45);
    EXPECT_GT(changed(before, turned), 0.02);
    const auto back = play({.input = {.turnLight = -1}}, 45);
    EXPECT_LT(changed(before, back), 0.002);
}

TEST_F(PlaybackTest, KnobsSetByTheScriptShowAndCanBeSetBack)
{
    play(pressing(Action::Pause));
    const auto before = play({}, 3);
    const auto unshadowed = play(setting("view", "unshadowed"), 2);
    EXPECT_GT(changed(before, unshadowed), 0.01);
    EXPECT_EQ(play(setting("view", "final"), 2), before);
}

TEST_F(PlaybackTest, TheOverlayComesAndGoes)
{
    play(pressing(Action::Pause));
    const auto before = play({}, 3);
    play(pressing(Action::ToggleOverlay));
    EXPECT_GT(changed(before, play({}, 2)), 0.1);
    play(pressing(Action::ToggleOverlay));
    EXPECT_EQ(play({}, 2), before);
}

TEST_F(PlaybackTest, ARecordingHoldsWhatWasAsked)
{
    play({.input = {.move = {0, 1}, .isRunning = true}}, 3);
    play(setting("occlusion.samples", "96"));
    play(pressing(Action::NextView));
    const Script& recording = playback_->recording();
    ASSERT_EQ(recording.steps.size(), 5u);
    EXPECT_EQ(recording.steps[0].input.move, vec2(0, 1));
    EXPECT_EQ(recording.steps[3].settings, (render::Settings{{"occlusion.samples", "96"}}));
    EXPECT_TRUE(recording.steps[4].input.asks(Action::NextView));
    EXPECT_TRUE(recording.steps[4].settings.empty());
    EXPECT_EQ(parseScript(scriptText(recording), "recording").steps, recording.steps);
}

TEST_F(PlaybackTest, ResizingBetweenFramesWaitsForNoneAndBreaksNone)
{
    for (uint32_t frame = 0; frame < 6; ++frame) {
        playback_->resize(kSize + 16u * (frame % 3));
        playback_->perform({});
        playback_->draw(kStepSeconds, nullptr, nullptr);
    }
    EXPECT_EQ(playback_->renderer().picture().width, kSize.x + 32);
}

TEST_F(PlaybackTest, StatisticsCountWhatWasMeasured)
{
    play({}, 5);
    EXPECT_EQ(playback_->profiler().frameMilliseconds().size(), 5u);
    EXPECT_THAT(playback_->stats(5), testing::HasSubstr("\"frames\": 5"));
}

} // namespace
} // namespace antumbra::app
