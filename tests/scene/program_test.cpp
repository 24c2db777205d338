// The program without a window: a script replays to the same state and the same bytes, and what is wrong ends in one line.
#include "base/error.h"
#include "scene/images.h"
#include "scene/process.h"
#include "unit/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace antumbra::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ProgramTest : public testing::Test
{
protected:
    struct Result
    {
        int code;
        std::string output;
    };
    Result run(std::vector<std::string> arguments, const std::vector<Process::Variable>& environment = {}) const
    {
        arguments.insert(arguments.begin(), ANTUMBRA_PROGRAM);
        const Path log = folder_ / "program.log";
        std::filesystem::remove(log);
        Process program(arguments, environment, log);
        const int code = program.wait(300).value_or(-2);
        return {code, readText(log)};
    }
    /// Plays the walk, and returns the line of the state hash and the last picture.
    std::pair<std::string, std::vector<std::byte>> playWalk(const std::string& threads) const
    {
        const Path picture = folder_ / "last.png";
        std::filesystem::remove(picture);
        const Result result = run({"play", "plaza", "--headless", "--size", "192x108", "--frames", "60", "--screenshot", picture},
                                  {{"LP_NUM_THREADS", threads}});
        if (result.code == static_cast<int>(ExitCode::NoDevice))
            return {"", {}};
        EXPECT_EQ(result.code, 0) << result.output;
        const size_t state = result.output.find("state ");
        return {state != std::string::npos ? result.output.substr(state) : "", readFile(picture)};
    }

    TestFolder folder_;
};

TEST_F(ProgramTest, ReplaysToTheSameBytesTwiceAndWithAnyNumberOfThreads)
{
    const auto first = playWalk("2");
    if (first.second.empty()) {
        ASSERT_EQ(std::getenv("ANTUMBRA_REQUIRE_DEVICE"), nullptr) << "no Vulkan device";
        GTEST_SKIP() << "no Vulkan device";
    }
    EXPECT_THAT(first.first, HasSubstr("after 60 steps"));
    EXPECT_EQ(playWalk("2"), first);
    EXPECT_EQ(playWalk("1"), first);
}

TEST_F(ProgramTest, TheAtriumPlaysByItsBakeAndItsLightTurns)
{
    const Path script = folder_ / "turn.jsonl", stats = projectPath("out") / "stats.json";
    writeText(script, "{\"script\": 1, \"seed\": 1, \"frames\": 12}\n{\"frame\": 2, \"rotate_environment\": 1}\n");
    const Result result = run({"play", "atrium", "--headless", "--size", "192x108", "--script", script});
    if (result.code == static_cast<int>(ExitCode::NoDevice)) {
        ASSERT_EQ(std::getenv("ANTUMBRA_REQUIRE_DEVICE"), nullptr) << "no Vulkan device";
        GTEST_SKIP() << "no Vulkan device";
    }
    ASSERT_EQ(result.code, 0) << result.output;
    EXPECT_THAT(result.output, Not(HasSubstr("without bake")));
    const nlohmann::json played = nlohmann::json::parse(readText(stats));
    for (const char* counter : {"nan_pixels", "inf_pixels", "negative_pixels"})
        EXPECT_EQ(played["counters"][counter], 0) << counter;
    for (const char* name : {"prt relight", "volume relight"}) {
        const auto pass = std::ranges::find_if(played["passes"], [&](const auto& each) { return each["name"] == name; });
        ASSERT_NE(pass, played["passes"].end()) << name;
        EXPECT_FALSE((*pass)["culled"]) << name;
    }
}

TEST_F(ProgramTest, VisibilityOfALightIsAShareThatItsShadowsTake)
{
    const Path picture = folder_ / "leak.png", visibility = folder_ / "visibility.exr";
    const Result result = run({"render", "leak", "--output", picture, "--size", "96x54", "--set", "area.scale=1", "--aov",
                               "visibility:lamp=" + visibility.string()});
    if (result.code == static_cast<int>(ExitCode::NoDevice)) {
        ASSERT_EQ(std::getenv("ANTUMBRA_REQUIRE_DEVICE"), nullptr) << "no Vulkan device";
        GTEST_SKIP() << "no Vulkan device";
    }
    ASSERT_EQ(result.code, 0) << result.output;
    const scene::ImageF share = scene::loadImageF(visibility);
    ASSERT_EQ(share.channels, 1u);
    EXPECT_THAT(share.values, testing::Each(AllOf(testing::Ge(0.0f), testing::Le(1.0f))));
    const auto count = [&](auto&& is) { return std::ranges::count_if(share.values, is); };
    EXPECT_GT(count([](float value) { return value == 1; }), 200) << "what nothing hides";
    EXPECT_GT(count([](float value) { return value > 0.05f && value < 0.95f; }), 50) << "penumbra";
    EXPECT_GT(count([](float value) { return value == 0; }), 50) << "umbra";
}

TEST_F(ProgramTest, VisibilityOfALightThatIsNotThereEndsInOneLineThatListsThem)
{
    const Result result = run({"render", "leak", "--output", folder_ / "leak.png", "--size", "96x54", "--aov",
                               "visibility:lmap=" + (folder_ / "v.exr").string()});
    if (result.code == static_cast<int>(ExitCode::NoDevice))
        GTEST_SKIP() << "no Vulkan device";
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.output, AllOf(HasSubstr("lmap"), HasSubstr("lamp")));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1);
}

TEST_F(ProgramTest, ABadScriptEndsInOneLineThatNamesIt)
{
    const Path script = folder_ / "bad.jsonl";
    writeText(script, "{\"script\": 1, \"seed\": 0, \"frames\": 5}\n{\"frame\": 7}\n");
    const Result result = run({"play", "--headless", "--script", script});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.output, HasSubstr(script.string() + ":2"));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1);
}

TEST_F(ProgramTest, AnUnknownSceneEndsInOneLineThatListsTheKnown)
{
    const Result result = run({"play", "--headless", "nowhere"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.output, AllOf(HasSubstr("nowhere"), HasSubstr("plaza"), HasSubstr("hall")));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1);
}

} // namespace
} // namespace antumbra::test
