#include "app/options.h"

#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>

namespace antumbra::app {
namespace {

using testing::HasSubstr;
using testing::Not;

Options parsed(std::initializer_list<const char*> words)
{
    std::vector<const char*> argv{"antumbra"};
    argv.insert(argv.end(), words);
    return parse(static_cast<int>(argv.size()), argv.data());
}

template <class Command>
Command parsedAs(std::initializer_list<const char*> words)
{
    return std::get<Command>(parsed(words));
}

std::string refusal(std::initializer_list<const char*> words)
{
    try {
        parsed(words);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::BadInput);
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "accepted";
}

TEST(Options, PlayNeedsNothing)
{
    const auto play = parsedAs<PlayOptions>({"play"});
    EXPECT_EQ(play.scene, "plaza");
    EXPECT_FALSE(play.headless);
    EXPECT_FALSE(play.size || play.frames || play.script || play.record || play.screenshot || play.targetMilliseconds);
    EXPECT_TRUE(play.settings.empty());
}

TEST(Options, PlayTakesAll)
{
    const auto play =
        parsedAs<PlayOptions>({"play", "hall", "--size", "320x180", "--headless", "--frames", "120", "--script", "in.json", "--record",
                               "out.json", "--screenshot", "a.png", "--target-ms", "33.3", "--set", "view=cones"});
    EXPECT_EQ(play.scene, "hall");
    EXPECT_EQ(play.size, uvec2(320, 180));
    EXPECT_TRUE(play.headless);
    EXPECT_EQ(play.frames, 120u);
    EXPECT_EQ(play.script, "in.json");
    EXPECT_EQ(play.record, "out.json");
    EXPECT_EQ(play.screenshot, "a.png");
    EXPECT_EQ(play.targetMilliseconds, 33.3);
    EXPECT_EQ(play.settings, (render::Settings{{"view", "cones"}}));
}

TEST(Options, RenderTakesAll)
{
    const auto render = parsedAs<RenderOptions>({"render", "crowd", "--output", "a.exr", "--size=8192x16", "--time", "1.5", "--frames", "9",
                                                 "--aov", "normal=n.exr", "--aov", "visibility:key=v.exr", "--stats", "s.json"});
    EXPECT_EQ(render.scene, "crowd");
    EXPECT_EQ(render.output, "a.exr");
    EXPECT_EQ(render.size, uvec2(8192, 16));
    EXPECT_EQ(render.seconds, 1.5);
    EXPECT_EQ(render.frames, 9u);
    EXPECT_EQ(render.stats, "s.json");
    ASSERT_EQ(render.aovs.size(), 2u);
    EXPECT_EQ(render.aovs[0].name, "normal");
    EXPECT_EQ(render.aovs[1].name, "visibility:key");
    EXPECT_EQ(render.aovs[1].file, "v.exr");
}

TEST(Options, OtherCommandsTakeTheirs)
{
    const auto eval = parsedAs<EvalOptions>({"eval", "irradiance", "cases.json", "--output", "results.json"});
    EXPECT_EQ(eval.kind, EvalKind::Irradiance);
    EXPECT_EQ(eval.cases, "cases.json");
    EXPECT_EQ(eval.output, "results.json");
    EXPECT_EQ(parsedAs<InspectOptions>({"inspect", "a.glb"}).file, "a.glb");
    EXPECT_TRUE(std::holds_alternative<InfoOptions>(parsed({"info"})));
    const auto graph = parsedAs<GraphOptions>({"graph", "hall", "--output", "g.dot", "--set", "reference.samples=1e6"});
    EXPECT_EQ(graph.scene, "hall");
    EXPECT_EQ(graph.output, "g.dot");
    EXPECT_EQ(graph.settings.size(), 1u);
}

TEST(Options, SettingsKeepTheirOrderAndTakeNoSceneForAValue)
{
    const auto play = parsedAs<PlayOptions>({"play", "--set", "occlusion.samples=64", "--set", "occlusion.samples=96", "hall"});
    EXPECT_EQ(play.settings, (render::Settings{{"occlusion.samples", "64"}, {"occlusion.samples", "96"}}));
    EXPECT_EQ(play.scene, "hall");
}

TEST(Options, HelpIsTextAndNamesTheKnobs)
{
    EXPECT_THAT(parsedAs<Help>({"--help"}).text, HasSubstr("inspect"));
    const std::string text = parsedAs<Help>({"render", "--help"}).text;
    EXPECT_THAT(text, HasSubstr("--aov"));
    for (const render::KnobDescription& knob : render::knobTable())
        EXPECT_THAT(text, HasSubstr(std::string(knob.key)));
}

TEST(Options, WhatIsUnknownNamesTheNearest)
{
    EXPECT_THAT(refusal({"rendr"}), HasSubstr("nearest is render"));
    EXPECT_THAT(refusal({"play", "--sise", "9x9"}), HasSubstr("nearest is --size"));
    EXPECT_THAT(refusal({"play", "--set", "occlusion.sample=64"}), HasSubstr("nearest is occlusion.samples"));
}

TEST(Options, WhatIsMissingIsNamed)
{
    EXPECT_THAT(refusal({}), HasSubstr("play, render"));
    EXPECT_THAT(refusal({"--headless"}), HasSubstr("play, render"));
    EXPECT_THAT(refusal({"render"}), HasSubstr("scene"));
    EXPECT_THAT(refusal({"render", "hall"}), HasSubstr("--output"));
    EXPECT_THAT(refusal({"render", "hall", "--output"}), HasSubstr("--output"));
    EXPECT_THAT(refusal({"eval", "cones", "--output", "r.json"}), HasSubstr("cases"));
    EXPECT_THAT(refusal({"inspect"}), HasSubstr("file"));
}

TEST(Options, SurplusIsRefused)
{
    EXPECT_THAT(refusal({"render", "a", "b", "--output", "c.exr"}), HasSubstr("\"b\""));
    EXPECT_THAT(refusal({"info", "x"}), HasSubstr("\"x\""));
    EXPECT_THAT(refusal({"play", "--frames", "1", "--frames", "2"}), HasSubstr("--frames"));
}

TEST(Options, SizesOutsideTheirRangeAreRefused)
{
    for (const char* size :
         {"", "x", "640", "640x", "x360", "15x16", "16x8193", "-16x16", "16x16x16", "16X16", "16.5x16", "16x16 ", "4294967312x16"})
        EXPECT_THAT(refusal({"play", "--size", size}), HasSubstr("--size: takes")) << size;
}

TEST(Options, NumbersOutsideTheirRangeAreRefused)
{
    for (const char* frames : {"0", "-1", "1.5", "1000001", "many", "4294967297"})
        EXPECT_THAT(refusal({"play", "--frames", frames}), HasSubstr("--frames: takes")) << frames;
    for (const char* seconds : {"-1", "nan", "inf", "1e9", "1s"})
        EXPECT_THAT(refusal({"render", "a", "--output", "b.exr", "--time", seconds}), HasSubstr("--time: takes")) << seconds;
}

TEST(Options, WordsOutsideTheirListAreRefused)
{
    EXPECT_THAT(refusal({"eval", "colours", "c.json", "--output", "r.json"}), HasSubstr("cones, irradiance, area or sdf"));
    EXPECT_THAT(refusal({"render", "a", "--output", "b.jpg"}), HasSubstr(".exr or .png"));
    EXPECT_THAT(refusal({"graph", "a", "--output", "b.exr"}), HasSubstr(".dot or .json"));
    for (const char* aov : {"normal", "=n.exr", "normal=", "normal=n.png"})
        EXPECT_THAT(refusal({"render", "a", "--output", "b.exr", "--aov", aov}), HasSubstr("--aov: takes")) << aov;
    for (const char* setting : {"view", "=final", "view="})
        EXPECT_THAT(refusal({"play", "--set", setting}), HasSubstr("--set: takes")) << setting;
    EXPECT_THAT(refusal({"play", "--set", "occlusion.samples=33"}), HasSubstr("32 to 1024"));
}

} // namespace
} // namespace antumbra::app
