// shaders/lib/disc.glsl on the device against integrals over discs and spheres in double.
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"

#include <functional>

namespace antumbra {
namespace {

using glm::dvec3;

struct In
{
    vec3 toCentre;
    float radius;
    vec3 normal;
};
struct Out
{
    vec3 vector;
    float cut;
};

constexpr double kPiExact = std::numbers::pi;
constexpr int kRings = 400, kSpokes = 400;

class LibDisc : public DeviceTest
{
protected:
    std::vector<Out> run(const std::vector<In>& inputs) { return runKernel<Out>(device(), "lib_functions.comp", "DISC", inputs); }
};

/// The vector form factor of a disc by its points.
dvec3 integral(const In& in)
{
    dvec3 sum{0};
    for (int ring = 0; ring < kRings; ++ring) {
        const double radius = double{in.radius} * (ring + 0.5) / kRings,
                     area = 2 * kPiExact * radius * double{in.radius} / kRings / kSpokes;
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const double turn = 2 * kPiExact * (spoke + 0.5) / kSpokes;
            const dvec3 to = dvec3(in.toCentre) + radius * dvec3(std::cos(turn), 0, std::sin(turn));
            const double distance2 = glm::dot(to, to);
            sum += to * (-to.y / (distance2 * distance2) * area / kPiExact);
        }
    }
    return sum;
}

In randomInput(RandomInputs& random)
{
    const double radius = random.logUniform(0.01, 100), height = radius * random.logUniform(0.03, 30);
    const dvec3 aside = radius * random.logUniform(1e-3, 30) * random.perpendicularTo({0, 1, 0});
    return {vec3(aside - dvec3(0, height, 0)), static_cast<float>(radius), vec3(random.direction())};
}

std::vector<In> randomInputs(uint32_t seed, size_t count)
{
    RandomInputs random(seed);
    std::vector<In> inputs(count);
    for (In& in : inputs)
        in = randomInput(random);
    return inputs;
}

TEST_F(LibDisc, VectorsAreTheIntegralOverTheDisc)
{
    const std::vector<In> inputs = randomInputs(1, 300);
    const std::vector<Out> outs = run(inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 expected = integral(inputs[i]);
        EXPECT_LT(glm::distance(dvec3(outs[i].vector), expected), 2e-3 * glm::length(expected) + 1e-7) << i;
    }
}

// The sphere whose vector it is, cut by the horizon: rays over its cone.
TEST_F(LibDisc, HorizonsCutWhatTheyCutOfASphere)
{
    RandomInputs random(3);
    const std::vector<In> inputs = randomInputs(2, 200);
    const std::vector<Out> outs = run(inputs);
    double greatest = 0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const double sine2 = glm::length(dvec3(outs[i].vector));
        const dvec3 axis = dvec3(outs[i].vector) / sine2, x = random.perpendicularTo(axis), y = glm::cross(axis, x);
        double sum = 0; // as dense as the cosine to the axis would be, taken back
        for (int ring = 0; ring < kRings; ++ring)
            for (int spoke = 0; spoke < kSpokes; ++spoke) {
                const double sine = std::sqrt(sine2 * (ring + 0.5) / kRings), turn = 2 * kPiExact * (spoke + 0.5) / kSpokes;
                const double cosine = std::sqrt(1 - sine * sine);
                const dvec3 direction = sine * (std::cos(turn) * x + std::sin(turn) * y) + cosine * axis;
                sum += std::max(glm::dot(direction, dvec3(inputs[i].normal)), 0.0) / cosine;
            }
        const double expected = sum * sine2 / (kRings * kSpokes);
        greatest = std::max(greatest, std::abs(double{outs[i].cut} - expected));
    }
    EXPECT_LT(greatest, 2e-3);
}

TEST_F(LibDisc, EveryDiscIsWorthAFiniteShareOfTheHemisphere)
{
    std::vector<In> inputs;
    const float sizes[]{0, 1e-30f, 1e-6f, 0.5f, 1, 1e6f, 1e18f};
    for (const float height : sizes)
        for (const float aside : sizes)
            for (const float radius : sizes)
                for (const vec3& normal : {vec3(0, 1, 0), vec3(0, -1, 0), vec3(1, 0, 0), vec3(-0.6f, -0.8f, 0)})
                    for (const float side : {-1.0f, 1.0f})
                        inputs.push_back({{aside, side * height, 0}, radius, normal});
    const std::vector<Out> outs = run(inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const In& in = inputs[i];
        SCOPED_TRACE(testing::Message() << in.toCentre.x << ' ' << in.toCentre.y << ' ' << in.radius << ' ' << in.normal.x << ' '
                                        << in.normal.y);
        EXPECT_LE(glm::length(outs[i].vector), 1.0001f);
        EXPECT_GE(outs[i].cut, 0.0f);
        EXPECT_LE(outs[i].cut, 1.0001f);
        if (in.toCentre.y >= 0) {
            EXPECT_EQ(outs[i].cut, 0.0f) << "discs face up";
        }
    }
}

} // namespace
} // namespace antumbra
