// shaders/lib/angle.glsl and cone_polygon.glsl on the device, against double and closed forms.
#include "gpu/area_twin_polygon.h"
#include "gpu/device_fixture.h"
#include "gpu/kernel.h"
#include "gpu/random_inputs.h"

#include <array>

namespace antumbra {
namespace {

using glm::dvec3;

constexpr double kPi2 = 2 * std::numbers::pi;

class LibArea : public DeviceTest
{
};

TEST_F(LibArea, AnglesAreExactAtBothEnds)
{
    struct In
    {
        vec3 a, b;
    };
    RandomInputs random(10);
    std::vector<In> inputs;
    for (uint32_t i = 0; i < 100000; ++i) {
        const dvec3 a = random.direction(), across = random.perpendicularTo(a);
        const double small = random.logUniform(1e-6, 1);
        const double angle = std::array{random.uniform(0, std::numbers::pi), small, std::numbers::pi - small, std::numbers::pi / 2}[i % 4];
        inputs.push_back({vec3(a), vec3(a * std::cos(angle) + across * std::sin(angle))});
    }
    inputs.push_back({{0, 0, 1}, {0, 0, 1}});
    inputs.push_back({{0, 0, 1}, {0, 0, -1}});
    const std::vector<float> outputs = runKernel<float>(device(), "lib_functions.comp", "ANGLE_BETWEEN", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const dvec3 a(inputs[i].a), b(inputs[i].b);
        const double angle = 2 * std::atan2(glm::length(a - b), glm::length(a + b));
        // Units in the last place of the angle, and what the vectors' own rounding makes of their lengths.
        ASSERT_NEAR(outputs[i], angle, 4e-7 * angle + (angle > 3 ? 4e-7 : 1e-9)) << i;
    }
}

struct PolygonIn
{
    std::array<vec3, 32> corners{};
    uint32_t count = 0;
    vec3 plane{0, 0, 1};
};
struct PolygonOut
{
    float whole, front, behind;
    uint32_t sides, frontCorners, behindCorners;
};

PolygonIn polygonOf(const std::vector<dvec3>& corners, const dvec3& plane = {0, 0, 1})
{
    PolygonIn in{.count = static_cast<uint32_t>(corners.size()), .plane = vec3(plane)};
    for (size_t i = 0; i < corners.size(); ++i)
        in.corners[i] = vec3(glm::normalize(corners[i]));
    return in;
}

class ConePolygon : public LibArea
{
protected:
    std::vector<PolygonOut> run(const std::vector<PolygonIn>& inputs)
    {
        return runKernel<PolygonOut>(device(), "lib_functions.comp", "CONE_POLYGON", inputs);
    }
    PolygonOut run(const PolygonIn& input) { return run(std::vector{input})[0]; }
};

/// A regular polygon at the angle from +Z.
std::vector<dvec3> ring(uint32_t corners, double angle)
{
    std::vector<dvec3> ring;
    for (uint32_t i = 0; i < corners; ++i) {
        const double around = kPi2 * i / corners;
        ring.emplace_back(std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle));
    }
    return ring;
}

TEST_F(ConePolygon, AnOctantIsAQuarterOfTheHemisphere)
{
    EXPECT_NEAR(run(polygonOf({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})).whole, 0.25, 1e-6);
    // Half of it, by cosine: the octant is symmetric about x = y.
    EXPECT_NEAR(run(polygonOf({{1, 0, 0}, {1, 1, 0}, {0, 0, 1}})).whole, 0.125, 1e-6);
    // The hemisphere: arcs of its rim, of a third and of a half, where ends are opposite and the arc's plane alone tells where it goes.
    EXPECT_NEAR(run(polygonOf(ring(3, std::numbers::pi / 2))).whole, 1, 1e-6);
    EXPECT_NEAR(run(polygonOf(ring(32, std::numbers::pi / 2))).whole, 1, 1e-6);
}

// Lambert: each arc adds its angle times the height of its plane's normal, over 2 pi. Of many corners that is the share of a disc, sin^2.
TEST_F(ConePolygon, RingsAreLambertsFormula)
{
    for (const double angle : {1e-4, 1e-2, 0.3, 1.0, 1.5, 1.57})
        for (const uint32_t corners : {3u, 4u, 7u, 32u}) {
            const std::vector<dvec3> of = ring(corners, angle);
            const double arc = std::acos(std::min(glm::dot(of[0], of[1]), 1.0));
            const double exact = angle < 1e-3 ? corners * 0.5 * angle * angle * std::sin(kPi2 / corners) / std::numbers::pi
                                              : corners / kPi2 * arc * glm::normalize(glm::cross(of[0], of[1])).z;
            // Corners are rounded by 6e-8: relatively, of a ring of 1e-4, by a thousandth.
            EXPECT_NEAR(run(polygonOf(of)).whole, exact, 2e-7 * std::sin(angle) + 2e-7 * exact) << corners << " at " << angle;
        }
    EXPECT_NEAR(run(polygonOf(ring(32, 0.5))).whole, std::sin(0.5) * std::sin(0.5), 2e-3) << "almost a disc";
}

// A square's share is its solid angle times the cosine, over pi, where it is small.
TEST_F(ConePolygon, ASmallSquareIsItsSolidAngle)
{
    for (const double size : {1e-2, 1e-3, 1e-4}) {
        const double share =
            run(polygonOf({{0.6 - size, -size, 0.8}, {0.6 + size, -size, 0.8}, {0.6 + size, size, 0.8}, {0.6 - size, size, 0.8}})).whole;
        const double exact = 4 * size * size * 0.8 * 0.8 / std::numbers::pi; // facing +Z, seen at an angle of 0.8
        EXPECT_NEAR(share / exact, 1, 6e-8 / size + 2 * size) << size;
    }
}

/// Convex, around a direction over the horizon.
PolygonIn randomPolygon(RandomInputs& random)
{
    dvec3 axis = random.direction();
    axis.z = std::abs(axis.z);
    const dvec3 across = random.perpendicularTo(axis), up = glm::cross(axis, across);
    const double width = random.logUniform(1e-3, 1.2);
    const uint32_t count = 3 + random.index(20);
    std::vector<dvec3> corners;
    for (uint32_t i = 0; i < count; ++i) {
        const double around = kPi2 * (i + random.uniform(0, 0.5)) / count;
        const dvec3 corner = axis + width * (across * std::cos(around) + up * std::sin(around));
        corners.emplace_back(corner.x, corner.y, std::max(corner.z, 0.0));
    }
    return polygonOf(corners, glm::normalize(random.index(2) == 0 ? glm::cross(corners[0], corners[count / 2])
                                                                  : random.perpendicularTo(axis) + axis * random.uniform(-width, width)));
}

TEST_F(ConePolygon, BothPartsOfACutAreTheWhole)
{
    RandomInputs random(11);
    std::vector<PolygonIn> inputs;
    for (uint32_t i = 0; i < 50000; ++i)
        inputs.push_back(randomPolygon(random));
    const std::vector<PolygonOut> outputs = run(inputs);
    uint32_t split = 0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const PolygonOut& out = outputs[i];
        ASSERT_NEAR(out.front + out.behind, out.whole, 1e-6) << i;
        split += out.frontCorners > 0 && out.behindCorners > 0 ? 1 : 0;
        twin::Polygon<double> polygon;
        for (uint32_t k = 0; k < inputs[i].count; ++k) {
            const dvec3 a(inputs[i].corners[k]), b(inputs[i].corners[(k + 1) % inputs[i].count]);
            polygon.push_back({a, glm::normalize(glm::cross(a, b)).z});
        }
        ASSERT_NEAR(out.whole, twin::formFactor(polygon), 1e-6) << i;
        ASSERT_NEAR(out.front, twin::formFactor(twin::split(polygon, dvec3(inputs[i].plane)).front), 2e-6) << i;
    }
    EXPECT_GT(split, inputs.size() / 2);
}

// Within 2e-7 of the plane a corner lies on it, and belongs to both parts.
TEST_F(ConePolygon, CornersOnThePlaneAreOnNeitherSide)
{
    const auto sides = [&](double height) { return run(polygonOf({{1, height, 0.2}, {0.5, 1, 0.5}, {-1, height, 0.2}}, {0, 1, 0})); };
    EXPECT_EQ(sides(0).sides, 1u);
    EXPECT_EQ(sides(1e-7).sides, 1u);
    EXPECT_EQ(sides(-1e-7).sides, 1u);
    EXPECT_EQ(sides(-1e-7).frontCorners, 3u);
    EXPECT_EQ(sides(-1e-7).behindCorners, 0u);
    EXPECT_EQ(sides(-1e-6).sides, 3u);
    EXPECT_EQ(sides(-1e-6).frontCorners, 3u);
    EXPECT_EQ(sides(-1e-6).behindCorners, 4u);
    EXPECT_EQ(run(polygonOf({{1, 0, 1}, {-1, 1e-8, 1}, {0, -1e-7, 1}}, {0, 1, 0})).sides, 0u) << "none is off the plane";
    EXPECT_EQ(run(polygonOf({{1, -1, 1}, {1, -0.5, 1}, {0, -0.5, 1}}, {0, 1, 0})).sides, 2u);
}

// A polygon that rounding made to cross a plane four times is on the side that it is more on (Guard 1): cut, its parts would overlap.
TEST_F(ConePolygon, FalseCrossingsAreDropped)
{
    const std::vector<dvec3> wavy{{1, 1e-6, 1}, {0.5, -1e-6, 1}, {0, 1e-6, 1}, {-0.5, -1e-6, 1}, {-1, 1e-6, 1}, {0, -1, 1}};
    const PolygonOut out = run(polygonOf({wavy.rbegin(), wavy.rend()}, {0, 1, 0}));
    EXPECT_EQ(out.frontCorners, 3u) << "those that count as on the plane now";
    EXPECT_NEAR(out.front, 0, 1e-6);
    EXPECT_NEAR(out.behind, out.whole, 1e-6);
}

} // namespace
} // namespace antumbra
