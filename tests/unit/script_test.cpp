// Scripts: what is written reads back equal, and what is wrong is told with its line.
#include "app/random.h"
#include "app/script.h"
#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace antumbra::app {
namespace {

using testing::HasSubstr;

constexpr const char* kHeader = "{\"script\": 1, \"seed\": 3, \"frames\": 10}\n";

Script parsed(const std::string& lines) { return parseScript(kHeader + lines, "walk.jsonl"); }

std::string complaintAbout(const std::string& text)
{
    try {
        parseScript(text, "walk.jsonl");
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::BadInput);
        return error.what();
    }
    return "no complaint";
}

std::string complaintAboutLine(const std::string& line) { return complaintAbout(kHeader + line); }

ScriptStep randomStep(Random& random)
{
    ScriptStep step;
    const float angle = random.between(0, 6);
    step.input.move = random.between(0, 1) * vec2(std::sin(angle), std::cos(angle));
    step.input.turnLight = random.between(-1, 1);
    step.input.isRunning = random.next() % 2 == 0;
    step.input.look = {random.between(-0.1f, 0.1f), 0};
    step.input.zoom = random.between(-1, 1);
    step.input.pressed = random.next() % (1u << kActionCount);
    if (random.next() % 4 == 0)
        step.settings = {{"occlusion.samples", "64"}, {"occlusion.scale", "1/2"}};
    if (random.next() % 4 == 0)
        step.splitColumn = random.next() % 600;
    return step;
}

TEST(Script, WhatIsWrittenReadsBackEqual)
{
    Random random(5);
    Script script{.seed = ~uint64_t{0}, .steps = {}};
    for (int step = 0; step < 500; ++step)
        script.steps.push_back(step % 3 != 0 && !script.steps.empty() ? script.steps.back() : randomStep(random));
    EXPECT_EQ(parseScript(scriptText(script), "script"), script);
}

TEST(Script, OnlyChangesAreWritten)
{
    Script script{.seed = 1, .steps = std::vector<ScriptStep>(600)};
    for (ScriptStep& step : script.steps)
        step.input.move = {0, 1};
    const std::string text = scriptText(script);
    EXPECT_EQ(std::ranges::count(text, '\n'), 2);
}

TEST(Script, MovesHoldAndPressesDoNot)
{
    const Script script = parsed("{\"frame\": 2, \"move\": [0, 1], \"press\": \"wave\"}\n{\"frame\": 5, \"move\": [0, 0]}\n");
    ASSERT_EQ(script.steps.size(), 10u);
    EXPECT_EQ(script.seed, 3u);
    EXPECT_EQ(script.steps[1].input, InputFrame{});
    EXPECT_TRUE(script.steps[2].input.asks(Action::Wave));
    EXPECT_FALSE(script.steps[3].input.asks(Action::Wave));
    EXPECT_EQ(script.steps[4].input.move, vec2(0, 1));
    EXPECT_EQ(script.steps[5].input.move, vec2(0));
    EXPECT_EQ(script.steps[9].input, InputFrame{});
}

TEST(Script, KnobsAndViewCanBeSet)
{
    const Script script = parsed("{\"frame\": 3, \"set\": [\"occlusion.samples=64\", \"view=cones\"], \"split\": 320}\n");
    EXPECT_EQ(script.steps[3].settings, (render::Settings{{"occlusion.samples", "64"}, {"view", "cones"}}));
    EXPECT_EQ(script.steps[3].splitColumn, 320u);
    EXPECT_TRUE(script.steps[4].settings.empty());
}

TEST(Script, EveryActionHasItsOwnName)
{
    for (uint32_t action = 0; action < kActionCount; ++action) {
        const std::string name(nameOf(static_cast<Action>(action)));
        const Script script = parsed("{\"frame\": 0, \"press\": [\"" + name + "\"]}\n");
        EXPECT_EQ(script.steps[0].input.pressed, 1u << action) << name;
    }
}

TEST(Script, WhatIsWrongIsToldWithFileAndLine)
{
    EXPECT_THAT(complaintAboutLine("{\"frame\": 1}\n{\"frame\": 1, \"mvoe\": [0, 1]}"), HasSubstr("walk.jsonl:3: unknown key \"mvoe\""));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 1, \"mvoe\": [0, 1]}"), HasSubstr("nearest is \"move\""));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 5}\n{\"frame\": 4}"), HasSubstr("walk.jsonl:3: frame 4 comes after frame 5"));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 10}"), HasSubstr("walk.jsonl:2"));
    EXPECT_THAT(complaintAboutLine("{\"frame\": -1}"), HasSubstr("walk.jsonl:2"));
    EXPECT_THAT(complaintAboutLine("{\"move\": [0, 1]}"), HasSubstr("\"frame\""));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 0, \"move\": [1, 1]}"), HasSubstr("at most 1 long"));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 0, \"move\": [\"a\", 1]}"), HasSubstr("\"move\" takes"));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 0, \"press\": [\"wawe\"]}"), HasSubstr("nearest is \"wave\""));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 0, \"set\": \"occlusion.samples=33\"}"), HasSubstr("occlusion.samples"));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 0, \"set\": \"occlusion.samples\"}"), HasSubstr("KEY=VALUE"));
    EXPECT_THAT(complaintAboutLine("{\"frame\": 0"), HasSubstr("walk.jsonl:2: not JSON"));
    EXPECT_THAT(complaintAboutLine("[]"), HasSubstr("walk.jsonl:2: not a JSON object"));
}

TEST(Script, TheHeaderIsChecked)
{
    EXPECT_THAT(complaintAbout(""), HasSubstr("an empty script"));
    EXPECT_THAT(complaintAbout("{\"script\": 2, \"seed\": 0, \"frames\": 1}"), HasSubstr("another format"));
    EXPECT_THAT(complaintAbout("{\"script\": 1, \"seed\": 0}"), HasSubstr("\"frames\""));
    EXPECT_THAT(complaintAbout("{\"script\": 1, \"seed\": 0, \"frames\": 2000000}"), HasSubstr("\"frames\""));
    EXPECT_THAT(complaintAbout("{\"script\": 1, \"seed\": 0, \"frames\": 0}\n{\"frame\": 0}"), HasSubstr("no frames"));
}

TEST(Script, TheShippedWalkIsAScriptOf120Frames)
{
    EXPECT_EQ(loadScript(projectPath("assets") / "scripts" / "walk.jsonl").steps.size(), 120u);
}

} // namespace
} // namespace antumbra::app
