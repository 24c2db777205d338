// The program in a real window: under Xvfb, moved by real key events, resized once; what stands on the screen is looked at.
#include "app/script.h"
#include "scene/images.h"
#include "scene/process.h"
#include "unit/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>
#include <unistd.h>

namespace antumbra::test {
namespace {

using testing::HasSubstr;
using testing::Not;

void sleepFor(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// A screen of 800x600 that nobody sees.
class Screen
{
public:
    explicit Screen(const Path& folder) : folder_(folder), number_(freeNumber()), server_(command(), {}, folder / "xvfb.log")
    {
        for (int attempt = 0; attempt < 100 && !std::filesystem::exists(socketOf(number_)); ++attempt)
            sleepFor(0.05);
    }

    [[nodiscard]] std::string name() const { return ":" + std::to_string(number_); }

    /// All of it, from the server's own memory, which it keeps in a file of X's dump format.
    [[nodiscard]] scene::Image8 look() const
    {
        const std::vector<std::byte> dump = readFile(folder_ / "Xvfb_screen0");
        const auto field = [&](size_t index) {
            uint32_t value = 0;
            for (size_t byte = 0; byte < 4; ++byte)
                value = value << 8 | static_cast<uint32_t>(dump.at(4 * index + byte));
            return value;
        };
        scene::Image8 image{.width = field(4), .height = field(5), .rgba = {}};
        const size_t first = field(0) + 12 * size_t{field(19)}, stride = field(12);
        for (size_t y = 0; y < image.height; ++y)
            for (size_t x = 0; x < image.width; ++x)
                for (const size_t channel : {2, 1, 0, 3}) // stored as BGRX
                    image.rgba.push_back(static_cast<uint8_t>(dump.at(first + y * stride + 4 * x + channel)));
        return image;
    }

private:
    static Path socketOf(int number) { return "/tmp/.X11-unix/X" + std::to_string(number); }
    static int freeNumber()
    {
        int number = 200 + getpid() % 500;
        while (std::filesystem::exists(socketOf(number)))
            ++number;
        return number;
    }
    [[nodiscard]] std::vector<std::string> command() const
    {
        return {"Xvfb", name(), "-screen", "0", "800x600x24", "-nolisten", "tcp", "-fbdir", folder_.string()};
    }

    Path folder_;
    int number_;
    Process server_;
};

/// Colours in a part of the screen.
size_t colorsIn(const scene::Image8& image, uvec2 from, uvec2 to)
{
    std::set<uint32_t> colors;
    for (uint32_t y = from.y; y < to.y; ++y)
        for (uint32_t x = from.x; x < to.x; ++x) {
            const uint8_t* pixel = &image.rgba[4 * (size_t{y} * image.width + x)];
            colors.insert(static_cast<uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]));
        }
    return colors.size();
}

class WindowTest : public testing::Test
{
protected:
    void SetUp() override
    {
        for (const char* program : {"Xvfb", "xdotool"})
            if (!isInstalled(program))
                GTEST_SKIP() << program << " is not installed";
    }

    void hands(const Screen& screen, std::vector<std::string> command) const
    {
        command.insert(command.begin(), "xdotool");
        Process process(command, {{"DISPLAY", screen.name()}}, folder_ / "xdotool.log");
        ASSERT_EQ(process.wait(60), 0) << readText(folder_ / "xdotool.log");
    }
    [[nodiscard]] Path file(const char* name) const { return folder_ / name; }

    TestFolder folder_;
};

TEST_F(WindowTest, PlaysByRealKeysAndIsResized)
{
    const Screen screen(folder_.path());
    Process game(
        {ANTUMBRA_PROGRAM, "play", "plaza", "--size", "320x180", "--record", file("record.jsonl"), "--screenshot", file("last.png")},
        {{"DISPLAY", screen.name()}, {"WAYLAND_DISPLAY", ""}, {"VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation"}}, file("game.log"));
    const std::string window = "Antumbra: plaza";
    hands(screen, {"search", "--sync", "--name", "^" + window + "$", "windowfocus", "--sync"});
    hands(screen, {"key", "F1"}); // the overlay goes
    hands(screen, {"keydown", "w"});
    sleepFor(1.5);
    hands(screen, {"keyup", "w"});
    hands(screen, {"search", "--name", window, "windowmove", "0", "0", "windowsize", "--sync", "400", "240"});
    sleepFor(2);
    const scene::Image8 seen = screen.look();
    hands(screen, {"key", "Escape"});
    const std::optional<int> code = game.wait(60);
    const std::string log = readText(file("game.log"));
    ASSERT_EQ(code, 0) << log;
    EXPECT_THAT(log, Not(HasSubstr("Validation Error")));

    const app::Script record = app::loadScript(file("record.jsonl"));
    const auto count = [&](auto holds) {
        return std::ranges::count_if(record.steps, [&](const app::ScriptStep& step) { return holds(step.input); });
    };
    EXPECT_GE(count([](const app::InputFrame& input) { return input.move == vec2(0, 1); }), 5);
    EXPECT_EQ(count([](const app::InputFrame& input) { return input.asks(app::Action::ToggleOverlay); }), 1);
    EXPECT_EQ(count([](const app::InputFrame& input) { return input.asks(app::Action::Quit); }), 1);

    const scene::Image8 last = scene::decodeImage8(readFile(file("last.png")), "last.png");
    EXPECT_EQ(last.width, 400u);
    EXPECT_EQ(last.height, 240u);
    EXPECT_GT(colorsIn(last, {0, 0}, {400, 240}), 500u);
    // The window fills its new size, and nothing of it lies beside.
    EXPECT_GT(colorsIn(seen, {0, 0}, {400, 240}), 500u);
    EXPECT_GT(colorsIn(seen, {330, 190}, {400, 240}), 8u); // an even floor in soft light: few colours, but a blank has one or two
    EXPECT_LE(colorsIn(seen, {410, 250}, {800, 600}), 2u);
}

TEST_F(WindowTest, DrawsNothingWhileHiddenAndLivesThroughTheSmallestSize)
{
    const Screen screen(folder_.path());
    Process game({ANTUMBRA_PROGRAM, "play", "plaza", "--size", "160x90", "--frames", "150"},
                 {{"DISPLAY", screen.name()}, {"WAYLAND_DISPLAY", ""}, {"VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation"}},
                 file("game.log"));
    const std::string window = "^Antumbra: plaza$";
    hands(screen, {"search", "--sync", "--name", window, "windowsize", "1", "1"});
    hands(screen, {"search", "--name", window, "windowunmap"});
    EXPECT_EQ(game.wait(6), std::nullopt) << "its 150 pictures take 2.5 s where they are drawn";
    hands(screen, {"search", "--name", window, "windowmap", "windowsize", "200", "120"});
    EXPECT_EQ(game.wait(120), 0) << readText(file("game.log"));
    EXPECT_THAT(readText(file("game.log")), Not(HasSubstr("Validation Error")));
}

} // namespace
} // namespace antumbra::test
