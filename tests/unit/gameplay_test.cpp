// The game without a device: scripted steps move the stage, and the same steps always move it the same way.
#include "app/script.h"
#include "app/stage.h"
#include "base/error.h"
#include "game/camera_rig.h"
#include "game/companion.h"
#include "game/gameplay.h"
#include "game/time_control.h"
#include "unit/allocation_counter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace antumbra::game {
namespace {

using app::Action;
using app::InputFrame;
using app::Stage;
using ecs::Each;

scene::SceneFile plaza()
{
    scene::SceneFile scene = app::findScene("plaza", {});
    scene.environment->file.clear(); // the light is not looked at here
    return scene;
}

Stage playedPlaza(uint64_t seed = 1) { return Stage(plaza(), seed, addGameplay); }

void run(Stage& stage, const InputFrame& input, int steps)
{
    for (int step = 0; step < steps; ++step)
        stage.step(input);
}

InputFrame pressing(Action action)
{
    InputFrame input;
    input.ask(action);
    return input;
}

template <class T>
const T& ofPlayer(const Stage& stage)
{
    for (auto [value] : Each<const T, ecs::With<Player>>(stage.world()))
        return value;
    throw std::logic_error("no player");
}

std::string clipOfPlayer(const Stage& stage)
{
    const uint32_t clip = ofPlayer<scene::Animator>(stage).clip;
    return stage.assets().models[ofPlayer<scene::Drawable>(stage).model].clips.at(clip).name;
}

vec3 playerPosition(const Stage& stage) { return ofPlayer<scene::Transform>(stage).position; }

float lightRotation(const Stage& stage)
{
    for (auto [environment] : Each<const scene::Environment>(stage.world()))
        return environment.rotationRadians;
    return NAN;
}

TEST(Gameplay, TheSameScriptGivesTheSameStateTwice)
{
    const app::Script walk = app::loadScript(projectPath("assets") / "scripts" / "walk.jsonl");
    Stage first = playedPlaza(walk.seed), second = playedPlaza(walk.seed);
    for (const app::ScriptStep& step : walk.steps) {
        first.step(step.input);
        second.step(step.input);
        ASSERT_EQ(first.stateHash(), second.stateHash()) << "step " << first.stepCount();
    }
}

TEST(Gameplay, LampsCircleAboutWhereTheyHangAndStopWithTheGame)
{
    Stage stage(app::findScene("stage", {}), 1, addGameplay);
    const auto places = [&] {
        std::vector<std::pair<vec3, float>> found; // from the centre, and how far that should be
        for (auto [transform, orbit] : Each<const scene::Transform, const scene::Orbit>(stage.world()))
            found.emplace_back(transform.position - orbit.centre, orbit.radius);
        return found;
    };
    run(stage, {}, 1);
    const auto before = places();
    ASSERT_EQ(before.size(), 3u);
    run(stage, {}, 30);
    const auto after = places();
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(glm::length(after[i].first), after[i].second, 1e-4);
        EXPECT_GT(glm::distance(after[i].first, before[i].first), 0.05f);
        EXPECT_EQ(after[i].first.y, 0);
    }
    run(stage, pressing(Action::Pause), 1);
    const auto paused = places();
    run(stage, {}, 30);
    EXPECT_EQ(places(), paused);
}

TEST(Gameplay, AnotherSeedOrInputGivesAnotherState)
{
    Stage stage = playedPlaza(1), otherSeed = playedPlaza(2), otherInput = playedPlaza(1);
    run(stage, {}, 10);
    run(otherSeed, {}, 10);
    run(otherInput, {.move = {0, 1}}, 10);
    EXPECT_NE(stage.stateHash(), otherSeed.stateHash());
    EXPECT_NE(stage.stateHash(), otherInput.stateHash());
}

TEST(Gameplay, AheadIsAwayFromTheCamera)
{
    Stage stage = playedPlaza();
    const vec3 before = playerPosition(stage);
    const float yaw = stage.world().resource<CameraRig>().yaw;
    run(stage, {.move = {0, 1}}, 90);
    const vec3 way = playerPosition(stage) - before;
    EXPECT_GT(glm::dot(glm::normalize(way), vec3(-std::sin(yaw), 0, -std::cos(yaw))), 0.9f);
    EXPECT_EQ(clipOfPlayer(stage), "walk");
    EXPECT_NEAR(ofPlayer<Character>(stage).speed, 1.4f, 0.05f);
}

TEST(Gameplay, RunsFasterThanItWalks)
{
    Stage stage = playedPlaza();
    run(stage, {.move = {0, 1}, .isRunning = true}, 90);
    EXPECT_NEAR(ofPlayer<Character>(stage).speed, 3.3f, 0.1f);
    EXPECT_EQ(clipOfPlayer(stage), "run");
}

TEST(Gameplay, StandsIdleWhenNothingIsAsked)
{
    Stage stage = playedPlaza();
    run(stage, {.move = {0, 1}}, 60);
    run(stage, {}, 60);
    const vec3 before = playerPosition(stage);
    run(stage, {}, 30);
    EXPECT_EQ(playerPosition(stage), before);
    EXPECT_EQ(clipOfPlayer(stage), "idle");
}

TEST(Gameplay, TurnsOnTheSpotBeforeItWalksBack)
{
    Stage stage = playedPlaza();
    run(stage, {.move = {0, 1}}, 60);
    run(stage, {}, 60);
    const vec3 before = playerPosition(stage);
    run(stage, {.move = {0, -1}}, 6);
    EXPECT_EQ(clipOfPlayer(stage), "turn");
    EXPECT_LT(glm::distance(playerPosition(stage), before), 0.01f);
    run(stage, {.move = {0, -1}}, 90);
    EXPECT_EQ(clipOfPlayer(stage), "walk");
    EXPECT_GT(playerPosition(stage).z, before.z);
}

TEST(Gameplay, StopsAtTheEdgeOfThePlane)
{
    Stage stage = playedPlaza();
    run(stage, pressing(Action::ChangeCamera), 1); // so that ahead stays ahead
    run(stage, {.move = {0, 1}, .isRunning = true}, 900);
    const vec3 position = playerPosition(stage);
    const Ground& ground = stage.world().resource<Ground>();
    EXPECT_EQ(ground.lowest, vec2(-6 + 0.35f));
    EXPECT_FLOAT_EQ(position.z, ground.lowest.y);
    EXPECT_GE(position.x, ground.lowest.x);
    EXPECT_EQ(position.y, 0);
    run(stage, {.move = {0, -1}, .isRunning = true}, 120);
    EXPECT_GT(playerPosition(stage).z, position.z + 1); // and comes back from there
}

TEST(Gameplay, WavesOnceAndThenStands)
{
    Stage stage = playedPlaza();
    run(stage, {}, 30);
    run(stage, pressing(Action::Wave), 1);
    run(stage, {}, 10);
    EXPECT_EQ(clipOfPlayer(stage), "wave");
    run(stage, {}, 200);
    EXPECT_EQ(clipOfPlayer(stage), "idle");
}

TEST(Gameplay, AWalkEndsAWave)
{
    Stage stage = playedPlaza();
    run(stage, pressing(Action::Wave), 1);
    run(stage, {.move = {0, 1}}, 60);
    EXPECT_EQ(clipOfPlayer(stage), "walk");
    run(stage, {}, 60);
    EXPECT_EQ(clipOfPlayer(stage), "idle");
}

TEST(Gameplay, PauseStopsCharactersButNeitherLightNorCamera)
{
    Stage stage = playedPlaza();
    run(stage, {.move = {0, 1}}, 30);
    run(stage, pressing(Action::Pause), 1);
    const vec3 position = playerPosition(stage);
    const uint64_t pose = ofPlayer<scene::Pose>(stage).version;
    const float light = lightRotation(stage), yaw = stage.world().resource<CameraRig>().yaw;
    run(stage, {.move = {0, 1}, .turnLight = 1, .look = {0.01f, 0}}, 60);
    EXPECT_EQ(playerPosition(stage), position);
    EXPECT_EQ(ofPlayer<scene::Pose>(stage).version, pose);
    EXPECT_NEAR(angleBetween(light, lightRotation(stage)), 0.8f, 1e-4f);
    EXPECT_GT(stage.world().resource<CameraRig>().yaw, yaw + 0.4f);
}

TEST(Gameplay, ASingleStepMovesOnceAndPausesAgain)
{
    Stage stage = playedPlaza();
    run(stage, {.move = {0, 1}}, 60);
    run(stage, pressing(Action::Pause), 1);
    const vec3 before = playerPosition(stage);
    InputFrame step{.move = {0, 1}};
    step.ask(Action::SingleStep);
    run(stage, step, 1);
    const vec3 after = playerPosition(stage);
    EXPECT_NEAR(glm::distance(before, after), 1.4f / 60, 0.005f);
    run(stage, {.move = {0, 1}}, 10);
    EXPECT_EQ(playerPosition(stage), after);
}

TEST(Gameplay, TimeScaleHalvesAndDoubles)
{
    Stage stage = playedPlaza();
    run(stage, pressing(Action::Slower), 1);
    EXPECT_EQ(stage.world().resource<Clock>().scale, 0.5f);
    EXPECT_FLOAT_EQ(stage.world().resource<ecs::Seconds>().value, 0.5f / 60);
    run(stage, pressing(Action::Faster), 10);
    EXPECT_EQ(stage.world().resource<Clock>().scale, 4);
    run(stage, pressing(Action::Slower), 20);
    EXPECT_EQ(stage.world().resource<Clock>().scale, 1.0f / 8);
}

TEST(Gameplay, TheCameraStartsAsTheScenePlacedItAndFollows)
{
    Stage stage = playedPlaza();
    const auto eye = [&] {
        for (auto [camera, transform] : Each<const scene::Camera, const scene::Transform>(stage.world()))
            return transform.position;
        return vec3(NAN);
    };
    const vec3 placed = plaza().camera.position;
    EXPECT_LT(glm::distance(eye(), placed), 1e-5f);
    run(stage, {}, 30);
    EXPECT_LT(glm::distance(eye(), placed), 1e-3f);
    const vec3 before = playerPosition(stage);
    run(stage, {.move = {0, 1}}, 120);
    const vec3 walked = playerPosition(stage) - before;
    EXPECT_NEAR(glm::distance(stage.world().resource<CameraRig>().target - plaza().camera.target, walked), 0, 0.4f);
}

TEST(Gameplay, TheCompanionTurnsToThePlayer)
{
    Stage stage = playedPlaza();
    run(stage, {.move = {1, 0}}, 240);
    run(stage, {}, 120);
    for (auto [character, transform] : Each<const Character, const scene::Transform, ecs::With<Companion>>(stage.world())) {
        const vec3 way = playerPosition(stage) - transform.position;
        EXPECT_LT(std::abs(angleBetween(character.facing, facingOf({way.x, way.z}))), 0.75f);
    }
}

TEST(Gameplay, ACharacterOfOneClipOnlySlides)
{
    scene::SceneFile scene = plaza();
    scene.entities.resize(2);
    scene.entities[1].mesh = {scene::MeshKind::Cube, {}};
    scene.entities[1].animation.reset();
    Stage stage(scene, 1, addGameplay);
    const vec3 before = playerPosition(stage);
    run(stage, {.move = {0, 1}}, 60);
    EXPECT_GT(glm::distance(playerPosition(stage), before), 0.2f);
}

TEST(Gameplay, ASceneWithoutCharactersCanBePlayed)
{
    scene::SceneFile scene = plaza();
    scene.entities.resize(1);
    Stage stage(scene, 1, addGameplay);
    run(stage, {.move = {0, 1}, .look = {0.01f, 0}}, 10);
    EXPECT_EQ(stage.stepCount(), 10u);
}

TEST(Gameplay, SteadyStepsAllocateNothing)
{
    Stage stage = playedPlaza();
    render::FrameView view;
    const auto step = [&] {
        stage.step({.move = {0, 1}});
        stage.extract(view);
    };
    for (int warm = 0; warm < 120; ++warm)
        step();
    const uint64_t before = test::allocationCount();
    for (int steady = 0; steady < 300; ++steady)
        step();
    EXPECT_EQ(test::allocationCount(), before);
}

TEST(FindScene, AnUnknownNameListsTheKnownOnes)
{
    try {
        app::findScene("plazza", {});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("plazza"), testing::HasSubstr("plaza"), testing::HasSubstr("hall")));
    }
}

} // namespace
} // namespace antumbra::game
