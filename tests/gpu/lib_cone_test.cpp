// shaders/lib/cone.glsl and intersect.glsl on the device against the same in double.
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"

namespace antumbra {
namespace {

using glm::dvec3;

struct In
{
    vec3 p, n, a, b;
    float radius;
    vec3 direction;
};
struct ConeOut
{
    vec3 axis;
    float cosine, chord, halfAngle, height;
    uint32_t all, holds;
};
struct Out
{
    ConeOut sphere;
    uint32_t mayMeetCapsule, isBehind, hitsSphere;
    float share;
};

constexpr size_t kCount = 100000;
constexpr double kHalfPi = std::numbers::pi / 2;

class LibCone : public DeviceTest
{
protected:
    std::vector<Out> run(const std::vector<In>& inputs) { return runKernel<Out>(device(), "lib_functions.comp", "BOUNDS", inputs); }
};

// From far and tiny to touching and inside, from spheres to rods that the ray runs along; rays aim at the capsule, its rim and past it.
In randomInput(RandomInputs& random)
{
    In in{};
    in.p = vec3(random.direction() * random.uniform(0, 3));
    in.n = vec3(random.direction());
    const double distance = random.logUniform(0.02, 200);
    const double share = random.index(4) == 0 ? 1 - random.logUniform(1e-6, 0.1) : random.logUniform(1e-4, 2);
    const dvec3 towards = random.direction();
    in.radius = static_cast<float>(distance * share);
    in.a = in.p + vec3(towards * distance);
    const double length = random.index(5) == 0 ? 0 : distance * random.logUniform(1e-4, 3);
    const dvec3 along = random.index(4) == 0 ? towards + 1e-4 * random.direction() : random.direction();
    in.b = in.a + vec3(glm::normalize(along) * length);
    const dvec3 through = glm::mix(dvec3(in.a), dvec3(in.b), random.uniform(0, 1)) - dvec3(in.p);
    const double off = random.index(2) == 0 ? random.uniform(0, 2) : 1 + (random.index(2) == 0 ? 1 : -1) * random.logUniform(1e-6, 0.1);
    in.direction = vec3(glm::normalize(through + random.perpendicularTo(glm::normalize(through)) * (double{in.radius} * off)));
    return in;
}

std::vector<In> randomInputs()
{
    RandomInputs random(1);
    std::vector<In> inputs(kCount);
    for (In& in : inputs)
        in = randomInput(random);
    return inputs;
}

double distanceToSegment(const dvec3& point, const dvec3& a, const dvec3& b)
{
    const double length2 = glm::dot(b - a, b - a);
    const double t = length2 > 0 ? std::clamp(glm::dot(point - a, b - a) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + t * (b - a));
}

// The distance to the segment is convex along the ray, so it is narrowed down.
double rayToSegment(const In& in, const dvec3& b)
{
    const dvec3 origin(in.p), direction = glm::normalize(dvec3(in.direction)), a(in.a);
    double near = 0, far = glm::distance(origin, a) + glm::distance(origin, b);
    for (int i = 0; i < 120; ++i) {
        const double first = near + (far - near) / 3, second = far - (far - near) / 3;
        const bool isNearer = distanceToSegment(origin + first * direction, a, b) < distanceToSegment(origin + second * direction, a, b);
        (isNearer ? far : near) = isNearer ? second : first;
    }
    return distanceToSegment(origin + 0.5 * (near + far) * direction, a, b);
}

// What float32 may be off by, for lengths of this case.
double lengthError(const In& in)
{
    const dvec3 p(in.p);
    return 1e-6 * (glm::distance(p, dvec3(in.a)) + glm::distance(p, dvec3(in.b)) + in.radius);
}

TEST_F(LibCone, ArcSineIsGoodToRounding)
{
    std::vector<float> sines{0, 1e-30f, 1e-10f, 0.5f, std::nextafter(0.5f, 1.0f), std::nextafter(1.0f, 0.0f), 1};
    for (size_t i = 0; i < kCount; ++i)
        sines.push_back(static_cast<float>(i) / kCount);
    const std::vector<float> angles = runKernel<float>(device(), "lib_functions.comp", "ARC_SINE", sines);
    for (size_t i = 0; i < sines.size(); ++i)
        ASSERT_NEAR(angles[i], std::asin(double{sines[i]}), 3e-7 * std::asin(double{sines[i]}) + 1e-37) << sines[i];
}

TEST_F(LibCone, ConesOfSpheresMatchDouble)
{
    const std::vector<In> inputs = randomInputs();
    const std::vector<Out> outputs = run(inputs);
    size_t parts = 0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 to = dvec3(inputs[i].a) - dvec3(inputs[i].p);
        const double distance = glm::length(to), radius = inputs[i].radius;
        const ConeOut& cone = outputs[i].sphere;
        ASSERT_NEAR(cone.height, distance + radius, 1e-6 * (distance + radius));
        const double inside = distance / radius - (1 + 1e-6);
        if (std::abs(inside) < 1e-6)
            continue;
        ASSERT_EQ(cone.all, inside < 0 ? 1u : 0u) << i;
        if (cone.all != 0) {
            ASSERT_EQ(cone.axis, inputs[i].n);
            ASSERT_FLOAT_EQ(cone.halfAngle, static_cast<float>(kHalfPi));
            continue;
        }
        ++parts;
        const double sine = radius / distance, psi = std::asin(sine);
        ASSERT_LT(glm::distance(dvec3(cone.axis), to / distance), 4e-7) << i;
        // The sine is good to rounding; towards a right angle the angle is worse by its tangent.
        ASSERT_NEAR(cone.halfAngle, psi, 5e-7 * psi + 4e-7 * std::tan(psi)) << i;
        ASSERT_LE(cone.cosine, std::cos(psi)) << i;
        ASSERT_NEAR(std::acos(std::min(double{cone.cosine}, 1.0)), psi, 1.5e-3) << i;
        ASSERT_NEAR(cone.chord, 2 * std::sin(psi / 2), 1e-6 * psi + std::min(2e-6 * std::tan(psi), 1.5e-3)) << i;
    }
    EXPECT_GT(parts, kCount / 2);
}

TEST_F(LibCone, BehindIsBelowThePlane)
{
    const std::vector<In> inputs = randomInputs();
    const std::vector<Out> outputs = run(inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const double above = glm::dot(dvec3(inputs[i].a) - dvec3(inputs[i].p), dvec3(inputs[i].n)) + double{inputs[i].radius};
        if (std::abs(above) > lengthError(inputs[i])) {
            ASSERT_EQ(outputs[i].isBehind, above < 0 ? 1u : 0u) << i;
        }
    }
}

TEST_F(LibCone, RaysHitAsInDouble)
{
    const std::vector<In> inputs = randomInputs();
    const std::vector<Out> outputs = run(inputs);
    size_t hits = 0, judged = 0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const double toSphere = rayToSegment(inputs[i], dvec3(inputs[i].a)) - double{inputs[i].radius};
        hits += toSphere <= 0 ? 1 : 0;
        if (std::abs(toSphere) > lengthError(inputs[i])) {
            ++judged;
            ASSERT_EQ(outputs[i].hitsSphere, toSphere < 0 ? 1u : 0u) << i << " by " << toSphere;
        }
    }
    EXPECT_GT(judged, kCount * 9 / 10);
    EXPECT_GT(hits, kCount / 8);
    EXPECT_LT(hits, kCount * 9 / 10);
}

TEST_F(LibCone, EveryRayThatHitsIsHeld)
{
    const std::vector<In> inputs = randomInputs();
    const std::vector<Out> outputs = run(inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const auto hits = [&](const dvec3& b) { return rayToSegment(inputs[i], b) <= double{inputs[i].radius}; };
        const ConeOut& cone = outputs[i].sphere;
        if (hits(dvec3(inputs[i].a))) {
            EXPECT_TRUE(cone.holds) << i << ' ' << cone.halfAngle;
            EXPECT_TRUE(cone.all != 0 || glm::dot(inputs[i].direction, cone.axis) >= cone.cosine) << i << ' ' << cone.halfAngle;
        }
        if (hits(dvec3(inputs[i].b))) {
            EXPECT_TRUE(outputs[i].mayMeetCapsule) << i;
        }
    }
}

// From a few radii off, a long capsule must not hold what misses it by as much again as it is thick.
TEST_F(LibCone, CapsulesHoldFewRaysThatMiss)
{
    RandomInputs random(3);
    std::vector<In> inputs(kCount);
    for (In& in : inputs) {
        in.n = {0, 1, 0};
        in.a = vec3(random.direction());
        in.b = in.a + vec3(random.direction() * 0.5);
        in.radius = 0.08f;
        in.direction = vec3(glm::normalize(glm::mix(dvec3(in.a), dvec3(in.b), random.uniform(0, 1)) + 0.3 * random.direction()));
    }
    const std::vector<Out> outputs = run(inputs);
    size_t hits = 0, held = 0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        hits += rayToSegment(inputs[i], dvec3(inputs[i].b)) <= double{inputs[i].radius} ? 1 : 0;
        held += outputs[i].mayMeetCapsule;
    }
    EXPECT_GT(hits, kCount / 100);
    EXPECT_LT(held, hits * 3 / 2);
}

TEST_F(LibCone, ConesHoldLittleMoreThanTheSphere)
{
    const std::vector<In> inputs = randomInputs();
    const std::vector<Out> outputs = run(inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const ConeOut& cone = outputs[i].sphere;
        if (cone.all != 0 || cone.holds == 0)
            continue;
        const dvec3 to = dvec3(inputs[i].a) - dvec3(inputs[i].p), direction = glm::normalize(dvec3(inputs[i].direction));
        const double psi = std::asin(std::min(double{inputs[i].radius} / glm::length(to), 1.0));
        const double angle = 2 * std::asin(std::min(0.5 * glm::distance(direction, glm::normalize(to)), 1.0));
        ASSERT_LE(angle, psi + 3e-6 + std::min(2e-6 * std::tan(psi), 2e-3)) << i;
    }
}

TEST_F(LibCone, FiniteForEveryFiniteInput)
{
    constexpr float kValues[] = {0, 1, -1e18f, 1e18f, 1e-40f, -1e-20f, 1e-30f, 3e17f};
    RandomInputs random(2);
    const auto value = [&] { return kValues[random.index(std::size(kValues))]; };
    std::vector<In> inputs(kCount);
    for (In& in : inputs) {
        in = {.p = {value(), value(), value()}, .a = {value(), value(), value()}, .b = {value(), value(), value()}};
        in.n = vec3(random.direction());
        const dvec3 towards = 0.5 * (dvec3(in.a) + dvec3(in.b)) - dvec3(in.p);
        in.direction = vec3(glm::length(towards) > 0 ? glm::normalize(towards) : random.direction());
        in.radius = std::abs(value());
    }
    const std::vector<Out> outputs = run(inputs);
    for (size_t i = 0; i < outputs.size(); ++i) {
        const ConeOut& cone = outputs[i].sphere;
        ASSERT_TRUE(std::isfinite(cone.axis.x + cone.axis.y + cone.axis.z + cone.cosine + cone.chord + cone.halfAngle + cone.height)) << i;
        ASSERT_TRUE(std::isfinite(outputs[i].share)) << i;
        ASSERT_TRUE(outputs[i].mayMeetCapsule) << i << ": what overflows is held";
    }
}

} // namespace
} // namespace antumbra
