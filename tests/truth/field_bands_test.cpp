// Bands in the penumbras of distance fields: what is seen of a sphere light changes along lines over a floor as it does by rays, or bends
// where that does not. One smooth edge would not tell: cones step to other places for each receiver where several shapes are about them.
#include "gpu/device_fixture.h"
#include "gpu/field_upload.h"
#include "gpu/kernel.h"
#include "truth/field_scenes.h"

#include <numbers>

namespace antumbra::truth {
namespace {

using glm::dvec3;
using scene::SDFPrimitive;
using scene::SDFShape;

constexpr uint32_t kLines = 120, kPoints = 60;
constexpr double kSpacing = 0.012; // metres
constexpr float kLightRadius = 0.5f;

/// A floor, and four shapes over it.
FieldSteps randomGarden(RandomInputs& random)
{
    const auto number = [&](double least, double most) { return static_cast<float>(random.uniform(least, most)); };
    const auto place = [&] { return vec3(number(-0.8, 0.8), number(0.2, 1.6), number(-0.8, 0.8)); };
    std::vector<SDFPrimitive> shapes{{.shape = SDFShape::Plane}};
    shapes.push_back({.shape = SDFShape::Sphere, .centre = place(), .radius = number(0.1, 0.4)});
    shapes.push_back({.shape = SDFShape::Box, .centre = place(), .halfExtent = {number(0.05, 0.4), number(0.05, 0.4), number(0.05, 0.4)}});
    shapes.push_back({.shape = SDFShape::Capsule, .centre = place(), .end = place(), .radius = number(0.03, 0.15)});
    shapes.push_back({.shape = SDFShape::Torus,
                      .centre = place(),
                      .direction = vec3(random.direction()),
                      .radius = number(0.2, 0.5),
                      .minorRadius = number(0.03, 0.1)});
    return fieldOf(shapes);
}

struct Line
{
    FieldSteps field;
    vec3 light; // centre
    std::vector<dvec3> points;
    std::vector<double> seen; // by rays that keep their places on the light
};

std::vector<Line> randomLines()
{
    RandomInputs random(41);
    std::vector<Line> lines(kLines);
    for (uint32_t l = 0; l < kLines; ++l) {
        Line& line = lines[l];
        line.field = randomGarden(random);
        line.light = {static_cast<float>(random.uniform(-2, 2)), static_cast<float>(random.uniform(3, 5)), 0.5f};
        const double turn = random.uniform(0, 2 * std::numbers::pi);
        const dvec3 along(std::cos(turn), 0, std::sin(turn)), middle(random.uniform(-0.8, 0.8), 0.002, random.uniform(-0.8, 0.8));
        for (uint32_t i = 0; i < kPoints; ++i)
            line.points.push_back(middle + along * (kSpacing * (i - 0.5 * kPoints)));
    }
    std::vector<FieldReceiver> receivers(size_t{kLines} * kPoints);
    for (size_t i = 0; i < receivers.size(); ++i)
        receivers[i] = {.pixel = i, .position = lines[i / kPoints].points[i % kPoints], .normal = {0, 1, 0}};
    const std::vector<double> seen = eachOf(receivers, [&](const FieldReceiver& at, uint32_t) {
        const Line& line = lines[at.pixel / kPoints];
        return sphereSeen(line.field, at.position, dvec3(line.light), kLightRadius, 32, static_cast<uint32_t>(at.pixel / kPoints));
    });
    for (uint32_t l = 0; l < kLines; ++l)
        lines[l].seen.assign(seen.begin() + l * kPoints, seen.begin() + (l + 1) * kPoints);
    return lines;
}

double bend(double before, double here, double after) { return before - 2 * here + after; }

/// Second differences beyond the truth's.
struct Bends
{
    double rms = 0;
    int sharp = 0; // over 0.02, of kLines * (kPoints - 2)
};

class FieldBands : public DeviceTest
{
protected:
    Bends bendsOf(const std::vector<Line>& lines, uint32_t cones)
    {
        std::vector<FieldSteps> fields;
        for (const Line& line : lines)
            fields.push_back(line.field);
        const FieldUpload uploaded(device(), fields);
        std::vector<FieldAsk> asks;
        for (uint32_t l = 0; l < kLines; ++l)
            for (const dvec3& point : lines[l].points)
                asks.push_back({vec3(point), lines[l].light, kLightRadius, cones, uploaded[l]});
        const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, "SUB_CONES", asks);
        Bends bends;
        double squares = 0;
        for (uint32_t l = 0; l < kLines; ++l)
            for (uint32_t i = 1; i + 1 < kPoints; ++i) {
                const FieldSaid* here = &said[size_t{l} * kPoints + i];
                const std::vector<double>& seen = lines[l].seen;
                const double beyond = bend(here[-1].value, here[0].value, here[1].value) - bend(seen[i - 1], seen[i], seen[i + 1]);
                squares += beyond * beyond;
                bends.sharp += std::abs(beyond) > 0.02 ? 1 : 0;
            }
        bends.rms = std::sqrt(squares / (kLines * (kPoints - 2)));
        std::printf("%2u cones: second differences beyond the truth's %.4f RMS, %d over 0.02\n", cones, bends.rms, bends.sharp);
        return bends;
    }
};

TEST_F(FieldBands, PenumbrasBendAsTheTruthDoes)
{
    const std::vector<Line> lines = randomLines();
    int lit = 0, dark = 0;
    for (const Line& line : lines)
        for (const double seen : line.seen) {
            lit += seen == 1 ? 1 : 0;
            dark += seen == 0 ? 1 : 0;
        }
    EXPECT_LT(lit + dark, static_cast<int>(kLines * kPoints * 2 / 3)) << "a third of the points are in penumbras";
    // Twice the tolerances without second looks at the narrowest place make it 0.022, 0.016, 0.013, and twice as many sharp ones.
    struct Bar
    {
        uint32_t cones;
        double rms, sharp;
    };
    for (const Bar& bar : {Bar{4, 0.011, 0.046}, Bar{7, 0.0095, 0.028}, Bar{16, 0.008, 0.017}}) {
        const Bends bends = bendsOf(lines, bar.cones);
        EXPECT_LT(bends.rms, bar.rms) << bar.cones;
        EXPECT_LT(bends.sharp, bar.sharp * kLines * (kPoints - 2)) << bar.cones;
    }
}

} // namespace
} // namespace antumbra::truth
