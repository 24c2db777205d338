// What of a polygon is seen past a distance field, cell by cell, on the device: closed forms, and inputs that leave formulas without an
// answer.
#include "gpu/device_fixture.h"
#include "gpu/field_upload.h"
#include "gpu/kernel.h"

namespace antumbra {
namespace {

using scene::SDFPrimitive;
using scene::SDFShape;

const SDFPrimitive kFloor{.shape = SDFShape::Plane};

SDFPrimitive box(vec3 centre, vec3 half) { return {.shape = SDFShape::Box, .centre = centre, .halfExtent = half}; }

/// Over the origin, 2 m by 1 m, 4 m high.
CellsAsk askBelow(vec3 position, uint32_t cells, const shader::FieldsBlock& fields)
{
    return {position, {0, 1, 0}, {-1, 4, -0.5f}, {2, 0, 0}, {0, 0, 1}, cells, fields};
}

class FieldCells : public DeviceTest
{
protected:
    std::vector<FieldSaid> run(const std::vector<CellsAsk>& asks) { return runKernel<FieldSaid>(device(), kFieldKernel, "CELLS", asks); }
};

TEST_F(FieldCells, AnEdgeHidesWhatIsBehindIt)
{
    // Walls up to the plane x = 0, one thick and one a sheet, leave the half of a light from there; a roof leaves nothing.
    const FieldUpload uploaded(device(),
                               {fieldOf({kFloor}), fieldOf({kFloor, box({2, 2, 0}, {2, 0.3f, 9})}),
                                fieldOf({kFloor, box({2, 2, 0}, {2, 0.02f, 9})}), fieldOf({kFloor, box({0, 2, 0}, {9, 0.3f, 9})})});
    constexpr float kSeen[] = {1, 0.5f, 0.5f, 0};
    for (const uint32_t cells : {1u, 2u, 6u, 8u, 32u}) {
        std::vector<CellsAsk> asks;
        for (size_t field = 0; field < 4; ++field)
            asks.push_back(askBelow({0, 0.001f, 0}, cells, uploaded[field]));
        const std::vector<FieldSaid> said = run(asks);
        for (size_t field = 0; field < 4; ++field)
            EXPECT_NEAR(said[field].value, kSeen[field], 0.01) << cells << " cells, field " << field;
    }
}

TEST_F(FieldCells, WhatIsBehindTheLightHidesNothing)
{
    const FieldUpload uploaded(device(), {fieldOf({kFloor, box({0, 4.55f, 0}, {9, 0.5f, 9})})});
    for (const uint32_t cells : {1u, 8u})
        for (const FieldSaid& each : run({askBelow({0, 0.001f, 0}, cells, uploaded[0]), askBelow({3, 0.5f, -2}, cells, uploaded[0])}))
            EXPECT_NEAR(each.value, 1, 0.001) << cells;
}

// Balls that share a group are looked at together, each of a field of its own only where a cone meets it.
TEST_F(FieldCells, WhatNoConeMeetsMakesNoDifference)
{
    constexpr int kFields = 300;
    RandomInputs random(31);
    std::vector<FieldSteps> fields;
    for (int i = 0; i < kFields; ++i) {
        std::vector<SDFPrimitive> balls{kFloor};
        for (int ball = 0; ball < 4; ++ball)
            balls.push_back({.shape = SDFShape::Sphere,
                             .centre = vec3(random.uniform(-1.5, 1.5), random.uniform(0.5, 4.5), random.uniform(-1, 1)),
                             .radius = static_cast<float>(random.logUniform(0.02, 0.5))});
        fields.push_back(fieldOf(balls));
        fields.push_back(fields.back());
        for (shader::FieldStepBlock& step : fields.back())
            step.flags |= shader::kFieldBegins;
    }
    const FieldUpload uploaded(device(), fields);
    std::vector<CellsAsk> asks;
    for (int i = 0; i < 2 * kFields; ++i)
        asks.push_back(askBelow({0.3f, 0.001f, -0.2f}, 8, uploaded[i]));
    const std::vector<FieldSaid> said = run(asks);
    int cut = 0;
    double squares = 0; // cones go other steps where there is less about them
    for (int i = 0; i < kFields; ++i) {
        squares += std::pow(said[2 * i].value - said[2 * i + 1].value, 2);
        cut += said[2 * i].value > 0 && said[2 * i].value < 1 ? 1 : 0;
    }
    EXPECT_LT(std::sqrt(squares / kFields), 0.005);
    EXPECT_GT(cut, kFields / 4);
}

TEST_F(FieldCells, PenumbrasHaveNoBands)
{
    constexpr int kSteps = 400;
    const FieldUpload uploaded(device(), {fieldOf({kFloor, box({2, 2, 0}, {2, 0.3f, 9})})});
    std::vector<CellsAsk> asks;
    for (int i = 0; i < kSteps; ++i)
        asks.push_back(askBelow({-1.5f + 3.0f * static_cast<float>(i) / kSteps, 0.001f, 0.1f}, 8, uploaded[0]));
    const std::vector<FieldSaid> said = run(asks);
    EXPECT_EQ(said.front().value, 1);
    EXPECT_EQ(said.back().value, 0);
    for (int i = 1; i + 1 < kSteps; ++i)
        EXPECT_LT(std::abs(said[i - 1].value - 2 * said[i].value + said[i + 1].value), 0.03) << i;
}

TEST_F(FieldCells, HardInputsHaveAnAnswer)
{
    const FieldUpload uploaded(device(), {fieldOf({kFloor, box({1, 2, 0}, {1, 0.3f, 1})}), FieldSteps{}});
    std::vector<CellsAsk> asks;
    for (const shader::FieldsBlock& fields : {uploaded[0], uploaded[1]}) {
        const vec3 p(0, 0.001f, 0);
        asks.push_back(askBelow({0, -1, 0}, 8, fields));     // in the solid
        asks.push_back(askBelow({0, 4, 0}, 8, fields));      // on the light
        asks.push_back(askBelow({5, 4, 0}, 8, fields));      // in its plane
        asks.push_back(askBelow({-1, 4, -0.5f}, 8, fields)); // at a corner
        asks.push_back(askBelow({0, 3.9999f, 0}, 8, fields));
        asks.push_back(askBelow({1, 1.7f, 0}, 8, fields));                             // on a surface
        asks.push_back({p, {0, -1, 0}, {-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, 8, fields}); // below the horizon
        asks.push_back({p, {1, 0, 0}, {-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, 8, fields});  // across it
        asks.push_back({p, {0, 1, 0}, {0, 4, 0}, {0, 0, 0}, {0, 0, 0}, 8, fields});    // a point
        asks.push_back({p, {0, 1, 0}, {0, 4, 0}, {1, 0, 0}, {2, 0, 0}, 8, fields});    // a line
        asks.push_back({p, {0, 1, 0}, {-1e-6f, 4, 0}, {2e-6f, 0, 0}, {0, 0, 2e-6f}, 8, fields});
        asks.push_back({p, {0, 1, 0}, {-1e6f, 4, -1e6f}, {2e6f, 0, 0}, {0, 0, 2e6f}, 8, fields});   // a sky
        asks.push_back({p, {0, 1, 0}, {-1e6f, 1e6f, 0}, {2e6f, 0, 0}, {0, 0, 1e6f}, 8, fields});    // far away
        asks.push_back({p, {0, 1, 0}, {-50, 1, -0.001f}, {100, 0, 0}, {0, 0, 0.002f}, 16, fields}); // a wire
        asks.push_back({p, {0, 1, 0}, {-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, 0, fields});               // no cells
        asks.push_back({p, {0, 1, 0}, {-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, 97, fields});
    }
    const std::vector<FieldSaid> said = run(asks);
    for (size_t i = 0; i < said.size(); ++i)
        EXPECT_TRUE(said[i].value >= 0 && said[i].value <= 1) << i << ": " << said[i].value;
    EXPECT_EQ(said[0].value, 0);
    EXPECT_EQ(said[asks.size() / 2 + 2].value, 1) << "nothing is hidden without a field";
}

TEST_F(FieldCells, AnyFieldGivesAShare)
{
    constexpr uint32_t kCount = 3000;
    RandomInputs random(31);
    std::vector<FieldSteps> fields;
    for (uint32_t i = 0; i < kCount / 10; ++i)
        fields.push_back(randomField(random, 1 + random.index(9)));
    const FieldUpload uploaded(device(), fields);
    std::vector<CellsAsk> asks;
    for (uint32_t i = 0; i < kCount; ++i) {
        const auto vector = [&] { return vec3(random.direction() * random.logUniform(0.01, 5)); };
        asks.push_back({vector(), vec3(random.direction()), vector(), vector(), vector(), 1 + random.index(20), uploaded[i / 10]});
    }
    const std::vector<FieldSaid> said = run(asks);
    for (uint32_t i = 0; i < kCount; ++i)
        ASSERT_TRUE(said[i].value >= 0 && said[i].value <= 1) << i << ": " << said[i].value;
}

} // namespace
} // namespace antumbra
