// Distance fields in double: shapes against closed forms, operations, and what marches rely on: slopes of one at most, and bounds that
// hold.
#include "render/field_order.h"
#include "render/field_steps.h"
#include "render/field_structure.h"

#include "tests/gpu/random_fields.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace antumbra;
using glm::dvec2;
using glm::dvec3;
using render::fieldDistance;
using scene::SDFOperation;
using scene::SDFPrimitive;
using scene::SDFShape;

double distanceTo(const SDFPrimitive& primitive, const dvec3& point, const mat4& world = mat4{1})
{
    return fieldDistance(fieldOf({primitive}, world), point);
}

struct Known
{
    SDFPrimitive primitive;
    dvec3 point;
    double distance;
};

TEST(FieldSteps, ShapesHaveTheirDistances)
{
    const SDFPrimitive sphere{.shape = SDFShape::Sphere, .centre = {1, 2, 3}, .radius = 0.5f};
    const SDFPrimitive box{.shape = SDFShape::Box, .halfExtent = {1, 2, 3}};
    const SDFPrimitive rounded{.shape = SDFShape::RoundedBox, .halfExtent = {1, 2, 3}, .radius = 0.25f};
    const SDFPrimitive torus{.shape = SDFShape::Torus, .direction = {0, 0, 1}, .radius = 2, .minorRadius = 0.5f};
    const SDFPrimitive capsule{.shape = SDFShape::Capsule, .centre = {0, 0, -1}, .end = {0, 0, 1}, .radius = 0.5f};
    const SDFPrimitive cylinder{.shape = SDFShape::Cylinder, .direction = {1, 0, 0}, .radius = 1, .height = 4};
    const SDFPrimitive cone{.shape = SDFShape::Cone, .radius = 3, .minorRadius = 0, .height = 4};
    const SDFPrimitive plane{.shape = SDFShape::Plane, .direction = {0, 0.6f, 0.8f}, .offset = 2};
    const Known known[] = {
        {sphere, {1, 2, 5}, 1.5},    {sphere, {1, 2, 3}, -0.5},       {box, {3, 0, 0}, 2},        {box, {4, 6, 0}, 5},
        {box, {3, 4, 4}, 3},         {box, {0.5, 0, 0}, -0.5},        {rounded, {4, 6, 0}, 4.75}, {rounded, {0.5, 0, 0}, -0.75},
        {torus, {0, 0, 0}, 1.5},     {torus, {5, 0, 4}, 4.5},         {torus, {0, 2, 0}, -0.5},   {capsule, {3, 0, 5}, 4.5},
        {capsule, {0, 2, 0.5}, 1.5}, {capsule, {0, 0, 0}, -0.5},      {cylinder, {0, 3, 0}, 2},   {cylinder, {5, 0, 0.5}, 3},
        {cylinder, {5, 0, 5}, 5},    {cylinder, {1.75, 0, 0}, -0.25}, {cone, {0, 3, 0}, 1},       {cone, {0, -3, 1}, 1},
        {cone, {0, 0, 0}, -1.2}, // to the side: its line is 4 x + 3 y = 6
        {cone, {3.5, 1, 0}, 2.2},    {cone, {6, -6, 0}, 5},           {plane, {0, 5, 5}, 5},
    };
    for (const Known& each : known)
        EXPECT_NEAR(distanceTo(each.primitive, each.point), each.distance, 1e-6)
            << "shape " << static_cast<int>(each.primitive.shape) << " at " << each.point.x << ' ' << each.point.y << ' ' << each.point.z;
}

TEST(FieldSteps, TurnsMovesAndScalesTakeDistancesAlong)
{
    RandomInputs random(1);
    for (int i = 0; i < 200; ++i) {
        SDFPrimitive primitive = randomPrimitive(random);
        primitive.operation = SDFOperation::Union;
        const double scale = random.logUniform(0.1, 10);
        const glm::dquat turn = glm::angleAxis(random.uniform(0, 6), random.direction());
        const dvec3 move = random.direction() * 3.0, point = random.direction() * random.uniform(0, 4);
        const mat4 world =
            glm::translate(mat4{1}, vec3(move)) * glm::mat4_cast(glm::quat(turn)) * glm::scale(mat4{1}, vec3(static_cast<float>(scale)));
        EXPECT_NEAR(distanceTo(primitive, move + turn * (scale * point), world), scale * distanceTo(primitive, point), 3e-5 * scale) << i;
    }
}

TEST(FieldSteps, OperationsRunInOrder)
{
    const auto ball = [](float x, SDFOperation operation, float blend = 0) {
        return SDFPrimitive{.centre = {x, 0, 0}, .radius = 1, .operation = operation, .blend = blend};
    };
    const dvec3 point(0.25, 0, 0); // -0.75 in the first ball, -0.25 in the second
    const SDFPrimitive first = ball(0, SDFOperation::Union);
    EXPECT_NEAR(fieldDistance(fieldOf({first, ball(1, SDFOperation::Union)}), point), -0.75, 1e-6);
    EXPECT_NEAR(fieldDistance(fieldOf({first, ball(1, SDFOperation::Subtract)}), point), 0.25, 1e-6);
    EXPECT_NEAR(fieldDistance(fieldOf({first, ball(1, SDFOperation::Intersect)}), point), -0.25, 1e-6);
    EXPECT_NEAR(fieldDistance(fieldOf({first, ball(1, SDFOperation::SmoothUnion, 1)}), point), -0.75 - 0.25 / 4, 1e-6);
    EXPECT_NEAR(fieldDistance(fieldOf({first, ball(1, SDFOperation::SmoothUnion, 0)}), point), -0.75, 1e-6);
    EXPECT_EQ(fieldDistance({}, point), 1e9);
    FieldSteps two = fieldOf({first, ball(1, SDFOperation::Subtract)});
    const FieldSteps cut = fieldOf({ball(0.25f, SDFOperation::Union)});
    two.insert(two.end(), cut.begin(), cut.end());
    EXPECT_NEAR(fieldDistance(two, point), -1, 1e-6) << "a new field is not cut by the one before";
}

TEST(FieldSteps, DistancesChangeNoFasterThanOneGoes)
{
    RandomInputs random(2);
    for (int i = 0; i < 3000; ++i) {
        const FieldSteps field = randomField(random, 1 + random.index(8));
        for (int j = 0; j < 30; ++j) {
            const dvec3 a = random.direction() * random.uniform(0, 4), b = a + random.direction() * random.logUniform(1e-4, 4);
            const double fa = fieldDistance(field, a), fb = fieldDistance(field, b), way = glm::distance(a, b);
            ASSERT_LE(std::abs(fa - fb), way * (1 + 1e-5)) << "field " << i;
        }
    }
}

TEST(FieldSteps, BoundsHoldTheirShapes)
{
    RandomInputs random(3);
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
        SDFPrimitive primitive = randomPrimitive(random);
        primitive.operation = SDFOperation::Union;
        const FieldSteps field{render::fieldStep(primitive, randomPlace(random)).value()};
        const render::FieldBound bound = render::boundOf(field[0]);
        if (primitive.shape == SDFShape::Plane) {
            EXPECT_GT(bound.radius, 0.01f * render::kFieldUnbounded);
            continue;
        }
        for (int j = 0; j < 100; ++j) {
            const double share = random.uniform(0, 1.2);
            const bool isSolid = fieldDistance(field, dvec3(bound.centre) + random.direction() * (share * bound.radius)) < 0;
            inside += isSolid ? 1 : 0;
            ASSERT_FALSE(isSolid && share > 1.0001) << i;
        }
    }
    EXPECT_GT(inside, 1000);
}

TEST(FieldSteps, BoxesOfGroupsHoldTheirSteps)
{
    RandomInputs random(6);
    std::vector<shader::FieldGroupBlock> groups;
    int outside = 0;
    for (int i = 0; i < 300; ++i) {
        const FieldSteps field = randomField(random, 1 + random.index(30));
        render::writeGroups(field, groups);
        for (const shader::FieldGroupBlock& group : groups)
            for (int j = 0; j < 30 && group.reach < render::kFieldUnbounded; ++j) {
                const dvec3 point = dvec3(group.centre) + random.direction() * random.uniform(0, 2.0 * group.reach);
                const double away = glm::length(glm::max(glm::abs(point - dvec3(group.centre)) - dvec3(group.halfEdges), 0.0));
                outside += away > 0 ? 1 : 0;
                for (uint32_t step = group.firstStep; step < group.endStep && away > 0; ++step) {
                    shader::FieldStepBlock alone = field[step];
                    alone.operation = shader::kFieldUnion;
                    ASSERT_GE(fieldDistance(std::span(&alone, 1), point), group.slope * away - 1e-6 * (1 + away)) << i << ' ' << step;
                    ASSERT_LE(alone.blend, group.melt);
                }
            }
    }
    EXPECT_GT(outside, 1000);
}

TEST(FieldSteps, GroupsHoldEachStepOnceInOrder)
{
    RandomInputs random(4);
    std::vector<shader::FieldGroupBlock> groups;
    for (int i = 0; i < 300; ++i) {
        const FieldSteps field = randomField(random, 1 + random.index(100));
        render::writeGroups(field, groups);
        uint32_t next = 0;
        for (const shader::FieldGroupBlock& group : groups) {
            EXPECT_EQ(group.firstStep, next);
            EXPECT_LE(group.endStep - group.firstStep, render::mostInGroup(field.size()));
            EXPECT_GT(group.endStep, group.firstStep);
            for (uint32_t step = group.firstStep + 1; step < group.endStep; ++step)
                EXPECT_EQ(field[step].flags & shader::kFieldBegins, 0u);
            next = group.endStep;
        }
        EXPECT_EQ(next, field.size());
    }
    render::writeGroups({}, groups);
    EXPECT_TRUE(groups.empty());
}

TEST(FieldSteps, PlainUnionsInARowMayChangePlaces)
{
    RandomInputs random(5);
    render::FieldOrder order;
    for (int i = 0; i < 100; ++i) {
        FieldSteps field = randomField(random, 1 + random.index(60));
        for (size_t step = 1; step < field.size(); ++step)
            if (random.index(3) != 0)
                field[step].operation = shader::kFieldUnion;
        FieldSteps ordered;
        for (const uint32_t index : order.of(field))
            ordered.push_back(field[index]);
        ASSERT_EQ(ordered.size(), field.size());
        for (int k = 0; k < 20; ++k) {
            const dvec3 point = random.direction() * random.uniform(0, 4);
            EXPECT_EQ(fieldDistance(ordered, point), fieldDistance(field, point)) << i;
        }
    }
}

TEST(FieldSteps, TheNearestOfThePartsIsTheNearestOfAll)
{
    RandomInputs random(8);
    std::vector<shader::FieldGroupBlock> groups;
    std::vector<render::FieldPart> parts;
    size_t most = 0;
    for (int i = 0; i < 200; ++i) {
        FieldSteps field = randomField(random, 1 + random.index(40));
        for (size_t step = 1; step < field.size(); ++step) {
            if (random.index(8) != 0)
                field[step].operation = shader::kFieldUnion;
            if (random.index(16) == 0)
                field[step].flags |= shader::kFieldBegins;
        }
        render::writeGroups(field, groups);
        render::writeParts(field, groups, parts);
        most = std::max(most, parts.size());
        ASSERT_EQ(parts.front().firstGroup, 0u);
        ASSERT_EQ(parts.back().endGroup, groups.size());
        for (int k = 0; k < 20; ++k) {
            const dvec3 point = random.direction() * random.uniform(0, 4);
            double nearest = render::kFieldUnbounded;
            uint32_t next = 0;
            for (const auto& [firstGroup, endGroup] : parts) {
                EXPECT_EQ(firstGroup, next);
                const uint32_t first = groups[firstGroup].firstStep, end = groups[endGroup - 1].endStep;
                nearest = std::min(nearest, fieldDistance(std::span(field).subspan(first, end - first), point));
                next = endGroup;
            }
            EXPECT_EQ(nearest, fieldDistance(field, point)) << i;
        }
    }
    EXPECT_GT(most, 4u);
}

TEST(FieldSteps, PlacesAreKeptAsThingsMove)
{
    RandomInputs random(7);
    std::vector<SDFPrimitive> balls;
    for (int i = 0; i < 40; ++i)
        balls.push_back({.shape = SDFShape::Sphere, .centre = vec3(random.direction() * random.uniform(0, 10)), .radius = 0.1f});
    render::FieldOrder order;
    const auto of = [&](const FieldSteps& field) {
        const std::span<const uint32_t> found = order.of(field);
        return std::vector<uint32_t>(found.begin(), found.end());
    };
    const std::vector<uint32_t> first = of(fieldOf(balls));
    for (SDFPrimitive& ball : balls)
        ball.centre = vec3(random.direction() * random.uniform(0, 10));
    EXPECT_EQ(of(fieldOf(balls)), first);
    balls.pop_back();
    EXPECT_EQ(of(fieldOf(balls)).size(), balls.size());
}

TEST(FieldSteps, TheStructureIsThatOfShapesAndOperations)
{
    const SDFPrimitive box{.shape = SDFShape::Box, .halfExtent = {1, 1, 1}};
    SDFPrimitive ball{.shape = SDFShape::Sphere, .radius = 1, .operation = SDFOperation::Subtract};
    const auto structure = [&] {
        const FieldSteps steps = fieldOf({box, ball});
        std::vector<shader::FieldGroupBlock> groups;
        render::writeGroups(steps, groups);
        std::string text;
        render::writeStructure(steps, groups, text);
        return text;
    };
    const std::string before = structure();
    EXPECT_EQ(before, "FIELD_BEGINS FIELD_GROUP(0) FIELD_STEP(0, unionOf, unionShare, boxStep) FIELD_ENDS "
                      "FIELD_GROUP(1) FIELD_STEP(1, differenceOf, differenceShare, segmentStep) FIELD_ENDS ");
    ball.radius = 2;
    ball.centre = {1, 2, 3};
    EXPECT_EQ(structure(), before);
    ball.operation = SDFOperation::SmoothUnion;
    EXPECT_NE(structure(), before);
    std::string none = "left";
    const FieldSteps many = fieldOf(std::vector(render::kMostWrittenSteps + 1, box));
    std::vector<shader::FieldGroupBlock> groups;
    render::writeGroups(many, groups);
    render::writeStructure(many, groups, none);
    EXPECT_TRUE(none.empty());
}

TEST(FieldSteps, InOrderGroupsAreSmaller)
{
    RandomInputs random(6);
    std::vector<SDFPrimitive> balls;
    for (int i = 0; i < 128; ++i)
        balls.push_back({.shape = SDFShape::Sphere, .centre = vec3(random.direction() * random.uniform(0, 10)), .radius = 0.1f});
    const FieldSteps field = fieldOf(balls);
    FieldSteps ordered;
    render::FieldOrder order;
    for (const uint32_t index : order.of(field))
        ordered.push_back(field[index]);
    const auto meanReach = [](const FieldSteps& steps) {
        std::vector<shader::FieldGroupBlock> groups;
        render::writeGroups(steps, groups);
        double sum = 0;
        for (const shader::FieldGroupBlock& group : groups)
            sum += group.reach;
        return sum / static_cast<double>(groups.size());
    };
    EXPECT_LT(meanReach(ordered), 0.6 * meanReach(field));
}

TEST(FieldSteps, WhatIsNotFiniteIsNoStep)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(render::fieldStep({}, mat4{1}));
    EXPECT_FALSE(render::fieldStep({.radius = nan}, mat4{1}));
    EXPECT_FALSE(render::fieldStep({.centre = {0, infinite, 0}}, mat4{1}));
    EXPECT_FALSE(render::fieldStep({.shape = SDFShape::Capsule, .end = {nan, 0, 0}}, mat4{1}));
    EXPECT_FALSE(render::fieldStep({.operation = SDFOperation::SmoothUnion, .blend = nan}, mat4{1}));
    EXPECT_FALSE(render::fieldStep({}, glm::scale(mat4{1}, {1, 0, 1}))) << "flat";
    EXPECT_FALSE(render::fieldStep({}, mat4{nan}));
}

} // namespace
