// shaders/lib/field.glsl on the device against the same in double, and the coverage of a cap against its exact formula.
#include "gpu/device_fixture.h"
#include "gpu/field_upload.h"
#include "gpu/kernel.h"

namespace antumbra {
namespace {

using glm::dvec3;

class Field : public DeviceTest
{
};

TEST_F(Field, DistancesMatchDouble)
{
    constexpr uint32_t kFields = 600, kPoints = 40;
    RandomInputs random(11);
    std::vector<FieldSteps> fields;
    for (uint32_t i = 0; i < kFields; ++i)
        fields.push_back(randomField(random, 1 + random.index(i % 10 == 0 ? 60 : 9)));
    const FieldUpload uploaded(device(), fields);
    std::vector<FieldAsk> asks;
    for (uint32_t i = 0; i < kFields * kPoints; ++i)
        asks.push_back({.position = vec3(random.direction() * random.logUniform(0.1, 20)), .fields = uploaded[i / kPoints]});
    const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, "FIELD_DISTANCE", asks);
    for (size_t i = 0; i < asks.size(); ++i) {
        const double expected = render::fieldDistance(fields[i / kPoints], dvec3(asks[i].position));
        // Coordinates of a stretched space are up to 15 times as large, and rounded so.
        ASSERT_NEAR(said[i].value, expected, 4e-6 * (1 + std::abs(expected))) << "field " << i / kPoints << " point " << i % kPoints;
        ASSERT_EQ(said[i].evaluations, 1u);
    }
}

TEST_F(Field, DistancesAreTheSameWhereItIsKnownThatTheyAreNoMore)
{
    constexpr uint32_t kFields = 300, kPoints = 40;
    RandomInputs random(13);
    std::vector<FieldSteps> fields;
    for (uint32_t i = 0; i < kFields; ++i)
        fields.push_back(randomField(random, 1 + random.index(i % 3 == 0 ? 200 : 9)));
    const FieldUpload uploaded(device(), fields);
    std::vector<FieldAsk> asks;
    std::vector<double> expected;
    for (uint32_t i = 0; i < kFields * kPoints; ++i) {
        const dvec3 point = random.direction() * random.logUniform(0.1, 20);
        expected.push_back(render::fieldDistance(fields[i / kPoints], dvec3(vec3(point))));
        const double more = i % 2 == 0 ? 0 : random.logUniform(1e-4, 1);
        asks.push_back({.position = vec3(point), .radius = static_cast<float>(expected.back() + more), .fields = uploaded[i / kPoints]});
    }
    const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, "FIELD_DISTANCE_WITHIN", asks);
    for (size_t i = 0; i < asks.size(); ++i)
        ASSERT_NEAR(said[i].value, expected[i], 4e-6 * (1 + std::abs(expected[i]))) << "field " << i / kPoints << " point " << i % kPoints;
}

TEST_F(Field, NothingIsFarAway)
{
    const FieldUpload uploaded(device(), {FieldSteps{}});
    const auto said = runKernel<FieldSaid>(device(), kFieldKernel, "FIELD_DISTANCE", std::vector{FieldAsk{.fields = uploaded[0]}});
    EXPECT_EQ(said[0].value, 1e9f);
}

// Of a cap of half angle a, what a plane through the apex leaves at the angle b from the axis, sin b = m sin a.
double exactCoverage(double m, double sine)
{
    const double a = std::asin(sine), b = std::asin(m * sine);
    const double x = std::clamp(-std::tan(b) / std::tan(a), -1.0, 1.0);
    return (std::numbers::pi - std::acos(m) - std::cos(a) * std::acos(x)) / (2 * std::numbers::pi * std::pow(std::sin(a / 2), 2));
}

TEST_F(Field, CapsOfConesAreCoveredNearly)
{
    struct In
    {
        float m;
        float sine;
    };
    std::vector<In> inputs{{-1, 0.5f}, {1, 0.5f}, {0, 0.5f}, {-7, 0.1f}, {7, 0.1f}, {0.3f, 0}};
    RandomInputs random(12);
    for (int i = 0; i < 50000; ++i)
        inputs.push_back({static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.logUniform(1e-4, 0.5))});
    const std::vector<float> shares = runKernel<float>(device(), kFieldKernel, "CAP_COVERAGE", inputs);
    EXPECT_EQ(shares[0], 0);
    EXPECT_EQ(shares[3], 0);
    EXPECT_NEAR(shares[1], 1, 1e-6);
    EXPECT_NEAR(shares[4], 1, 1e-6);
    for (size_t i = 2; i < inputs.size(); ++i) {
        // Of the smallest caps the exact formula is a difference of angles that are nearly equal.
        const double m = std::clamp(double{inputs[i].m}, -1.0, 1.0);
        ASSERT_NEAR(shares[i], exactCoverage(m, std::max(double{inputs[i].sine}, 1e-3)), 0.002) << inputs[i].m << " of " << inputs[i].sine;
    }
}

// Against chords of the disc, added up.
TEST_F(Field, DiscsAreCoveredByRectangles)
{
    struct In
    {
        vec2 low;
        vec2 high;
    };
    std::vector<In> inputs{{{-2, -2}, {2, 2}}, {{-2, 0}, {0, 2}}, {{0.5f, -1}, {0.2f, 1}}, {{-1e30f, -1}, {0, 1e30f}}, {{1, 1}, {3, 3}}};
    RandomInputs random(13);
    const auto coordinate = [&] { return static_cast<float>(random.uniform(-1.2, 1.2)); };
    for (int i = 0; i < 2000; ++i)
        inputs.push_back({{coordinate(), coordinate()}, {coordinate(), coordinate()}});
    const std::vector<float> shares = runKernel<float>(device(), kFieldKernel, "RECTANGLE_SHARE", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        constexpr int kChords = 20000;
        double area = 0;
        for (int chord = 0; chord < kChords; ++chord) {
            const double y = (chord + 0.5) * 2 / kChords - 1, half = std::sqrt(1 - y * y);
            if (y > inputs[i].low.y && y < inputs[i].high.y)
                area += std::max(0.0, std::min(half, double{inputs[i].high.x}) - std::max(-half, double{inputs[i].low.x})) * 2 / kChords;
        }
        ASSERT_NEAR(shares[i], area / std::numbers::pi, 2e-4) << i;
    }
}

} // namespace
} // namespace antumbra
