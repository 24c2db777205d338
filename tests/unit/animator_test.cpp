#include "scene/animator.h"

#include "scene/gltf.h"
#include "tests/unit/allocation_counter.h"

#include <gtest/gtest.h>

namespace {

using namespace antumbra;
using namespace antumbra::scene;
using ecs::Each;
using ecs::Entity;
using ecs::World;

constexpr uint32_t kRise = 0; // one metre a second along Y, for two seconds
constexpr uint32_t kStay = 1; // five metres along X

/// One joint that two clips move; `morphCount` targets that none moves.
Model movingModel(uint32_t morphCount = 0)
{
    Model model = rigidModel("mover", makeCube(), {});
    model.restMorphWeights.resize(morphCount);
    model.clips.push_back({"rise", 2, {{Channel::Translation, 0, 3, Interpolation::Linear, {0, 2}, {0, 0, 0, 0, 2, 0}}}});
    model.clips.push_back({"stay", 1, {{Channel::Translation, 0, 3, Interpolation::Linear, {0}, {5, 0, 0}}}});
    return model;
}

/// A schedule of the two systems, and its world.
class Troupe
{
public:
    Troupe()
    {
        assets_.models = {movingModel(), movingModel(2)};
        world.setResource(assets_);
        world.setResource(PoseStore{});
        schedule_.add("assign poses", &assignPoses);
        schedule_.add("animate", &animate).after("assign poses");
        schedule_.compile();
    }

    Entity add(uint32_t model = 0) { return world.create(Drawable{model}, DynamicSkinned{}); }
    Entity addPlaying(Animator animator, uint32_t model = 0)
    {
        const Entity entity = add(model);
        world.add(entity, animator);
        step(0);
        return entity;
    }
    void step(float seconds)
    {
        world.setResource(ecs::Seconds{seconds});
        schedule_.run(world);
    }
    [[nodiscard]] const Pose& pose(Entity entity) const { return world.get<Pose>(entity); }
    [[nodiscard]] vec3 place(Entity entity) const { return vec3(world.resource<PoseStore>().joints(pose(entity))[0][3]); }
    [[nodiscard]] Animator& animator(Entity entity) { return world.get<Animator>(entity); }

    World world;

private:
    Assets assets_;
    ecs::Schedule schedule_;
};

void expectNear(vec3 actual, vec3 expected)
{
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(actual[i], expected[i], 1e-4f) << "component " << i;
}

TEST(Animator, NewcomersStandAtRest)
{
    Troupe troupe;
    const Entity plain = troupe.add();
    const Entity morphed = troupe.add(1);
    const Entity still = troupe.world.create(Drawable{0});
    troupe.step(1);
    EXPECT_EQ(troupe.place(plain), vec3(0));
    EXPECT_EQ(troupe.world.resource<PoseStore>().morphWeights(troupe.pose(morphed)).size(), 2u);
    EXPECT_NE(troupe.pose(plain).slot, troupe.pose(morphed).slot);
    EXPECT_FALSE(troupe.world.has<Pose>(still));
}

TEST(Animator, NewcomersThatPlayAreNeverSeenAtRest)
{
    Troupe troupe;
    EXPECT_EQ(troupe.place(troupe.addPlaying({.clip = kRise, .time = 0.5f})), vec3(0, 0.5f, 0));
}

TEST(Animator, SpeedScalesTimeAndClipsLoop)
{
    Troupe troupe;
    const Entity forwards = troupe.addPlaying({.clip = kRise, .speed = 2});
    const Entity backwards = troupe.addPlaying({.clip = kRise, .speed = -1});
    troupe.step(0.25f);
    expectNear(troupe.place(forwards), {0, 0.5f, 0});
    expectNear(troupe.place(backwards), {0, 1.75f, 0});
    troupe.step(10.5f); // 21 s on, and 10.5 s back
    expectNear(troupe.place(forwards), {0, 1.5f, 0});
    expectNear(troupe.place(backwards), {0, 1.25f, 0});
}

TEST(Animator, OneLongStepIsManyShortOnes)
{
    Troupe troupe;
    const Entity one = troupe.addPlaying({.clip = kRise, .time = 0.3f, .speed = 0.7f});
    for (int i = 0; i < 300; ++i)
        troupe.step(1.0f / 60);
    const vec3 stepped = troupe.place(one);
    const Entity other = troupe.addPlaying({.clip = kRise, .time = 0.3f, .speed = 0.7f});
    troupe.step(5);
    expectNear(troupe.place(other), stepped);
    EXPECT_GT(stepped.y, 0.1f);
}

TEST(Animator, TheVersionChangesWithThePoseOnly)
{
    Troupe troupe;
    const Entity entity = troupe.addPlaying({.clip = kRise});
    const uint64_t first = troupe.pose(entity).version;
    troupe.step(0);
    EXPECT_EQ(troupe.pose(entity).version, first) << "paused";
    troupe.step(0.5f);
    const uint64_t second = troupe.pose(entity).version;
    EXPECT_NE(second, first);
    troupe.step(2);
    EXPECT_EQ(troupe.pose(entity).version, second) << "a whole turn of the clip";
    troupe.animator(entity).speed = 0;
    troupe.step(0.5f);
    EXPECT_EQ(troupe.pose(entity).version, second);
}

TEST(Animator, AClipThatMovesNothingKeepsTheVersion)
{
    Troupe troupe;
    const Entity entity = troupe.addPlaying({.clip = kStay});
    const uint64_t version = troupe.pose(entity).version;
    troupe.step(0.3f);
    EXPECT_EQ(troupe.pose(entity).version, version);
    EXPECT_EQ(troupe.place(entity), vec3(5, 0, 0));
}

TEST(Animator, PlayFadesFromWhatWasPlayed)
{
    Troupe troupe;
    const Entity entity = troupe.addPlaying({.clip = kRise});
    troupe.step(0.5f);
    play(troupe.animator(entity), kStay, 1);
    troupe.step(0);
    expectNear(troupe.place(entity), {0, 0.5f, 0});
    troupe.step(0.25f); // what fades out goes on: at 0.75 m
    expectNear(troupe.place(entity), {1.25f, 0.75f * 0.75f, 0});
    troupe.step(0.75f);
    expectNear(troupe.place(entity), {5, 0, 0});
}

TEST(Animator, PlayAgainChangesNothingAndZeroCuts)
{
    Troupe troupe;
    const Entity entity = troupe.addPlaying({.clip = kRise});
    troupe.step(0.5f);
    play(troupe.animator(entity), kRise, 1);
    EXPECT_FLOAT_EQ(troupe.animator(entity).time, 0.5f);
    play(troupe.animator(entity), kStay, 0);
    troupe.step(0);
    EXPECT_EQ(troupe.place(entity), vec3(5, 0, 0));
    play(troupe.animator(entity), kNoIndex, 0);
    troupe.step(0);
    EXPECT_EQ(troupe.place(entity), vec3(0)) << "the rest pose";
}

TEST(Animator, AFadeTurnsBackWithoutAJump)
{
    Troupe troupe;
    const Entity entity = troupe.addPlaying({.clip = kRise});
    play(troupe.animator(entity), kStay, 1);
    troupe.step(0.25f);
    const vec3 before = troupe.place(entity);
    play(troupe.animator(entity), kRise, 2);
    troupe.step(0);
    expectNear(troupe.place(entity), before);
    troupe.step(0.25f);
    EXPECT_LT(troupe.place(entity).x, before.x);
    troupe.step(0.25f);
    expectNear(troupe.place(entity), {0, 0.75f, 0});
}

TEST(Animator, SlotsStayAndAreGivenAgain)
{
    Troupe troupe;
    const Entity first = troupe.addPlaying({.clip = kStay});
    const Entity second = troupe.addPlaying({.clip = kRise});
    const Pose left = troupe.pose(first);
    const uint32_t kept = troupe.pose(second).slot;
    troupe.world.destroy(first);
    troupe.step(0.5f);
    EXPECT_EQ(troupe.pose(second).slot, kept);

    const Entity larger = troupe.addPlaying({.clip = kRise}, 1);
    EXPECT_NE(troupe.pose(larger).slot, left.slot) << "another size";
    const Entity heir = troupe.addPlaying({.clip = kStay});
    EXPECT_EQ(troupe.pose(heir).slot, left.slot);
    EXPECT_EQ(troupe.place(heir), vec3(5, 0, 0));
    EXPECT_NE(troupe.pose(heir).version, left.version) << "though the pose is the same";
    EXPECT_EQ(troupe.pose(second).slot, kept);
}

TEST(Animator, WhoIsNoCharacterAnyMoreLosesItsPose)
{
    Troupe troupe;
    const Entity entity = troupe.addPlaying({.clip = kRise});
    const uint32_t slot = troupe.pose(entity).slot;
    troupe.world.remove<DynamicSkinned>(entity);
    troupe.step(0);
    EXPECT_FALSE(troupe.world.has<Pose>(entity));
    troupe.world.add(entity, DynamicSkinned{});
    troupe.step(0);
    EXPECT_EQ(troupe.pose(entity).slot, slot);
}

TEST(Animator, SteadyStepsAllocateNothing)
{
    Troupe troupe;
    for (uint32_t i = 0; i < 20; ++i)
        troupe.addPlaying({.clip = i % 2, .time = 0.1f * static_cast<float>(i)}, i % 2);
    const Entity fading = troupe.addPlaying({.clip = kRise}, 1);
    play(troupe.animator(fading), kStay, 3);
    auto& assets = troupe.world.resource<Assets>();
    auto& poses = troupe.world.resource<PoseStore>();
    const auto run = [&] { animate(Each<Animator, Pose, const Drawable>(troupe.world), assets, poses, {1.0f / 60}); };
    run();
    const uint64_t before = test::allocationCount();
    for (int i = 0; i < 300; ++i)
        run();
    EXPECT_EQ(test::allocationCount(), before);
}

TEST(Animator, RealCharactersPlayEveryClip)
{
    const Path file = Path(ANTUMBRA_SHARED_DIR) / "assets/characters/Fox.glb";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "there is no " << file;
    Troupe troupe;
    auto& assets = troupe.world.resource<Assets>();
    assets.models.push_back(loadGltf(file));
    const Entity fox = troupe.addPlaying({.clip = 0}, 2);
    std::vector<mat4> jointsBefore;
    for (uint32_t clip = 0; clip < assets.models[2].clips.size(); ++clip) {
        play(troupe.animator(fox), clip, 0.2f);
        troupe.step(0.3f);
        const auto joints = troupe.world.resource<PoseStore>().joints(troupe.pose(fox));
        EXPECT_FALSE(std::ranges::equal(joints, jointsBefore)) << assets.models[2].clips[clip].name;
        jointsBefore.assign(joints.begin(), joints.end());
    }
}

} // namespace
