// The table of controls: complete, without two meanings for one key, and read as it says.
#include "app/input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace antumbra::app {
namespace {

using testing::UnorderedElementsAreArray;

HandState holding(Key key)
{
    HandState hands;
    hands.keysHeld[static_cast<size_t>(key)] = true;
    return hands;
}

HandState pressing(Key key)
{
    HandState hands = holding(key);
    hands.keysPressed[static_cast<size_t>(key)] = true;
    return hands;
}

/// The left stick, to the right and up.
HandState leaning(vec2 stick)
{
    HandState hands;
    hands.sticks[static_cast<size_t>(PadAxis::LeftX)] = stick.x;
    hands.sticks[static_cast<size_t>(PadAxis::LeftY)] = stick.y;
    return hands;
}

TEST(Controls, EveryKeyHasExactlyOneMeaning)
{
    std::multiset<Key> used, all;
    for (const Control& control : controls())
        if (control.key != Key::None)
            used.insert(control.key);
    for (size_t key = 0; key < kKeyCount; ++key)
        all.insert(static_cast<Key>(key));
    EXPECT_EQ(used, all);
}

TEST(Controls, NoPadButtonHasTwoMeanings)
{
    std::set<PadButton> used;
    for (const Control& control : controls())
        if (control.button != PadButton::None) {
            EXPECT_TRUE(used.insert(control.button).second) << control.what;
        }
}

TEST(Controls, WhatPlayingTakesIsOnTheGamepadToo)
{
    std::set<Axis> axes;
    std::set<Action> actions;
    for (const Control& control : controls())
        if (control.stick != PadAxis::None || control.button != PadButton::None) {
            EXPECT_FALSE(control.padName.empty()) << control.what;
            if (control.isHeld)
                axes.insert(control.axis);
            else
                actions.insert(control.action);
        }
    EXPECT_EQ(axes.size(), kAxisCount);
    EXPECT_EQ(actions.size(), kActionCount - 2) << "all but screenshot and quit";
    EXPECT_FALSE(actions.contains(Action::Screenshot) || actions.contains(Action::Quit));
}

TEST(Controls, EveryActionHasAKey)
{
    for (uint32_t action = 0; action < kActionCount; ++action) {
        const auto asks = [action](const Control& control) {
            return !control.isHeld && control.action == static_cast<Action>(action) && control.key != Key::None;
        };
        EXPECT_TRUE(std::ranges::any_of(controls(), asks)) << "action " << action;
    }
}

TEST(Controls, EveryAxisCanBeHeldBothWaysByKeysUnlessItOnlyHasOne)
{
    std::set<std::pair<Axis, bool>> held;
    for (const Control& control : controls())
        if (control.isHeld && control.key != Key::None)
            held.insert({control.axis, control.amount > 0});
    for (size_t axis = 0; axis < kAxisCount; ++axis) {
        EXPECT_TRUE(held.contains({static_cast<Axis>(axis), true})) << "axis " << axis;
        if (static_cast<Axis>(axis) != Axis::Run) {
            EXPECT_TRUE(held.contains({static_cast<Axis>(axis), false})) << "axis " << axis;
        }
    }
}

TEST(Controls, TheListNamesEveryMeaningOnceWithItsKeys)
{
    std::set<std::string> meanings;
    for (const Control& control : controls())
        meanings.insert(std::string(control.what));
    std::vector<std::string> listed;
    for (const KeyLine& line : keyLines()) {
        listed.push_back(line.what);
        EXPECT_FALSE(line.keys.empty()) << line.what;
    }
    EXPECT_THAT(listed, UnorderedElementsAreArray(meanings));
    EXPECT_EQ(keyLines().front().what, "walk");
    EXPECT_EQ(keyLines().front().keys, "W A S D, left stick");
}

TEST(Input, HeldKeysMoveAsLongAsTheyAreHeld)
{
    Input input;
    input.take(holding(Key::W));
    EXPECT_EQ(input.nextStep().move, vec2(0, 1));
    EXPECT_EQ(input.nextStep().move, vec2(0, 1));
    input.take({});
    EXPECT_EQ(input.nextStep().move, vec2(0));
}

TEST(Input, TwoKeysTogetherMoveNoFasterThanOne)
{
    HandState hands = holding(Key::W);
    hands.keysHeld[static_cast<size_t>(Key::D)] = true;
    Input input;
    input.take(hands);
    EXPECT_NEAR(glm::length(input.nextStep().move), 1, 1e-6);
}

TEST(Input, APressReachesOneStepAndIsNotLostBetweenPictures)
{
    Input input;
    input.take(pressing(Key::F));
    input.take(holding(Key::F)); // another picture before any step
    EXPECT_TRUE(input.nextStep().asks(Action::Wave));
    EXPECT_FALSE(input.nextStep().asks(Action::Wave));
}

TEST(Input, DragAndWheelAddUpUntilTheNextStep)
{
    HandState hands;
    hands.drag = {10, 0};
    hands.wheel = 1;
    Input input;
    input.take(hands);
    input.take(hands);
    const InputFrame step = input.nextStep();
    EXPECT_LT(step.look.x, 0); // the hand drags the scene to the right: the camera goes left
    EXPECT_EQ(step.zoom, 2);
    EXPECT_EQ(input.nextStep().look, vec2(0));
}

TEST(Input, AStickAtRestMovesNothingAndAtItsEndMovesFully)
{
    Input input;
    input.take(leaning({0.1f, 0.1f}));
    EXPECT_EQ(input.nextStep().move, vec2(0));
    input.take(leaning({0, 1}));
    EXPECT_NEAR(input.nextStep().move.y, 1, 1e-6);
    input.take(leaning({1, -1})); // some pads reach into the corners
    EXPECT_NEAR(glm::length(input.nextStep().move), 1, 1e-6);
}

TEST(Input, ASlantedStickKeepsItsDirectionAndStartsGently)
{
    Input input;
    const vec2 direction = glm::normalize(vec2(0.2f, 1));
    input.take(leaning(0.16f * direction)); // just beyond the dead zone
    const vec2 gentle = input.nextStep().move;
    EXPECT_GT(glm::length(gentle), 0);
    EXPECT_LT(glm::length(gentle), 0.02f);
    input.take(leaning(0.6f * direction));
    EXPECT_NEAR(glm::distance(glm::normalize(input.nextStep().move), direction), 0, 1e-5);
}

TEST(Input, TheRightStickLooksAround)
{
    HandState hands;
    hands.sticks[static_cast<size_t>(PadAxis::RightX)] = 1;
    Input input;
    input.take(hands);
    const InputFrame step = input.nextStep();
    EXPECT_GT(step.look.x, 0);
    EXPECT_EQ(step.look.y, 0);
    EXPECT_EQ(step.move, vec2(0));
}

TEST(Input, HeldButtonsHoldAndPressedOnesAskOnce)
{
    HandState hands;
    for (const PadButton button : {PadButton::B, PadButton::Left, PadButton::X})
        hands.buttonsHeld[static_cast<size_t>(button)] = true;
    hands.buttonsPressed[static_cast<size_t>(PadButton::X)] = true;
    Input input;
    input.take(hands);
    const InputFrame first = input.nextStep();
    EXPECT_TRUE(first.isRunning);
    EXPECT_EQ(first.turnLight, 1);
    EXPECT_TRUE(first.asks(Action::Wave));
    const InputFrame second = input.nextStep();
    EXPECT_TRUE(second.isRunning);
    EXPECT_FALSE(second.asks(Action::Wave));
}

TEST(Input, AnUnpluggedGamepadLetsGo)
{
    HandState hands = leaning({0, 1});
    hands.buttonsHeld[static_cast<size_t>(PadButton::B)] = true;
    Input input;
    input.take(hands);
    input.take({}); // as Window reads no gamepad
    const InputFrame step = input.nextStep();
    EXPECT_EQ(step.move, vec2(0));
    EXPECT_FALSE(step.isRunning);
}

} // namespace
} // namespace antumbra::app
