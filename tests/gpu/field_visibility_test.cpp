// What of a sphere is seen past a distance field, on the device: inputs that leave formulas without an answer, and smooth penumbras.
#include "gpu/device_fixture.h"
#include "gpu/field_upload.h"
#include "gpu/kernel.h"

namespace antumbra {
namespace {

using scene::SDFOperation;
using scene::SDFPrimitive;
using scene::SDFShape;

constexpr std::string_view kMethods[] = {"QUILEZ", "AALTONEN", "ONE_CONE", "SUB_CONES"};

const SDFPrimitive kFloor{.shape = SDFShape::Plane};

SDFPrimitive ball(vec3 centre, float radius) { return {.shape = SDFShape::Sphere, .centre = centre, .radius = radius}; }
SDFPrimitive rod(vec3 from, vec3 to, float radius) { return {.shape = SDFShape::Capsule, .centre = from, .end = to, .radius = radius}; }
SDFPrimitive box(vec3 centre, vec3 half) { return {.shape = SDFShape::Box, .centre = centre, .halfExtent = half}; }

/// A point and a light before a field, and what is seen where that is certain.
struct Hard
{
    std::string name;
    std::vector<SDFPrimitive> field;
    vec3 position;
    vec3 centre;
    float radius;
    std::optional<float> seen = {};
};

std::vector<Hard> hardCases()
{
    const vec3 p(0, 0.002f, 0), light(0, 5, 0);
    const SDFPrimitive roof = box({0, 2, 0}, {3, 0.2f, 3});
    SDFPrimitive everything = ball({0, 0, 0}, 100);
    everything.operation = SDFOperation::Subtract;
    std::vector<Hard> cases{
        {"nothing", {}, p, light, 1, 1},
        {"floor", {kFloor}, p, light, 1, 1},
        {"under a roof", {kFloor, roof}, p, light, 1, 0},
        {"in a solid", {ball({0, 0, 0}, 1)}, {0, 0.5f, 0}, light, 1, 0},
        {"on a surface", {ball({0, 0, 0}, 1)}, {0, 1, 0}, light, 1, 0},
        {"in the light", {kFloor}, p, {0, 0.3f, 0}, 1, 1},
        {"at the light's centre", {kFloor}, {0, 1, 0}, {0, 1, 0}, 1, 1},
        {"on the light", {kFloor}, {0, 1, 0}, {0, 2, 0}, 1, 1},
        {"at a light without size", {kFloor}, {0, 1, 0}, {0, 1, 0}, 0, 1},
        {"the light touches a surface", {kFloor, roof}, {4, 3, 0}, {0, 3.2f, 0}, 1},
        {"a wall behind the light", {kFloor, box({0, 7, 0}, {9, 0.95f, 9})}, p, light, 1, 1},
        {"the light is in a solid", {ball({0, 5, 0}, 2)}, p, light, 1, 0},
        {"a light without size", {kFloor, ball({1, 2, 0}, 0.5f)}, p, light, 0, 1},
        {"a hidden light without size", {kFloor, roof}, p, light, 0, 0},
        {"a huge light about the point", {kFloor}, p, light, 1e6f, 1},
        {"a huge light", {kFloor}, p, {0, 1.001e6f, 0}, 1e6f},
        {"a huge light behind a ball", {kFloor, ball({0, 2, 0}, 0.5f)}, p, {0, 1e6f + 10, 0}, 1e6f},
        {"a light far away", {kFloor, ball({0, 2, 0}, 0.5f)}, p, {0, 1e6f, 0}, 1, 0},
        {"grazing", {kFloor}, p, {5, 0.2f, 0}, 1},
        {"below the horizon", {kFloor}, p, {5, -2, 0}, 1, 0},
        {"along the floor", {kFloor}, {0, 1e-6f, 0}, {100, 0, 0}, 1},
        {"everything subtracted", {kFloor, roof, everything}, p, light, 1, 1},
        {"subtracted from nothing", {everything}, p, light, 1, 1},
    };
    for (uint32_t shape = 0; shape <= static_cast<uint32_t>(SDFShape::Cone); ++shape) {
        const SDFPrimitive empty{.shape = static_cast<SDFShape>(shape),
                                 .centre = {0, 2, 0},
                                 .end = {0, 2, 0},
                                 .halfExtent = vec3(0),
                                 .radius = 0,
                                 .minorRadius = 0,
                                 .height = 0,
                                 .operation = SDFOperation::SmoothUnion};
        cases.push_back({"without size, shape " + std::to_string(shape), {kFloor, empty}, p, light, 1});
        cases.push_back({"at a shape without size, shape " + std::to_string(shape), {empty}, {0, 2, 0}, light, 1, 0});
    }
    return cases;
}

class FieldVisibility : public DeviceTest
{
};

TEST_F(FieldVisibility, HardInputsHaveAnAnswer)
{
    const std::vector<Hard> cases = hardCases();
    std::vector<FieldSteps> fields;
    for (const Hard& each : cases)
        fields.push_back(fieldOf(each.field));
    const FieldUpload uploaded(device(), fields);
    for (const std::string_view method : kMethods)
        for (const uint32_t cones : {1u, 4u, 7u, 16u}) {
            if (method != "SUB_CONES" && cones != 1)
                continue;
            std::vector<FieldAsk> asks;
            for (size_t i = 0; i < cases.size(); ++i)
                asks.push_back({cases[i].position, cases[i].centre, cases[i].radius, cones, uploaded[i]});
            const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, method, asks);
            for (size_t i = 0; i < cases.size(); ++i) {
                EXPECT_GE(said[i].value, 0) << method << cones << ' ' << cases[i].name;
                EXPECT_LE(said[i].value, 1) << method << cones << ' ' << cases[i].name;
                if (method == "SUB_CONES" && cones > 1 && cases[i].seen) {
                    EXPECT_NEAR(said[i].value, *cases[i].seen, 0.01) << cones << ' ' << cases[i].name;
                }
            }
        }
}

TEST_F(FieldVisibility, AnyFieldGivesAShare)
{
    constexpr uint32_t kCount = 4000;
    RandomInputs random(21);
    std::vector<FieldSteps> fields;
    for (uint32_t i = 0; i < kCount / 10; ++i)
        fields.push_back(randomField(random, 1 + random.index(9)));
    const FieldUpload uploaded(device(), fields);
    std::vector<FieldAsk> asks;
    for (uint32_t i = 0; i < kCount; ++i)
        asks.push_back({vec3(random.direction() * random.logUniform(0.01, 10)), vec3(random.direction() * random.logUniform(0.01, 10)),
                        static_cast<float>(random.logUniform(1e-6, 10)), 7, uploaded[i / 10]});
    for (const std::string_view method : kMethods) {
        const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, method, asks);
        for (uint32_t i = 0; i < kCount; ++i)
            ASSERT_TRUE(said[i].value >= 0 && said[i].value <= 1) << method << ' ' << i << ": " << said[i].value;
    }
}

/// Shares along a line over the floor from full light to none, and their largest second difference.
struct Profile
{
    std::vector<float> shares;
    double roughest = 0;
};

Profile profileOf(gpu::Device& device, const std::vector<SDFPrimitive>& blockers, uint32_t cones)
{
    constexpr int kSteps = 400;
    std::vector<SDFPrimitive> field{kFloor};
    field.insert(field.end(), blockers.begin(), blockers.end());
    const FieldUpload uploaded(device, {fieldOf(field)});
    std::vector<FieldAsk> asks;
    for (int i = 0; i < kSteps; ++i)
        asks.push_back({{-1.5f + 3.0f * static_cast<float>(i) / kSteps, 0.002f, 0.1f}, {0, 5, 0}, 0.8f, cones, uploaded[0]});
    Profile profile;
    for (const FieldSaid& each : runKernel<FieldSaid>(device, kFieldKernel, "SUB_CONES", asks))
        profile.shares.push_back(each.value);
    for (int i = 1; i + 1 < kSteps; ++i)
        profile.roughest =
            std::max(profile.roughest, std::abs(double{profile.shares[i - 1]} - 2 * profile.shares[i] + profile.shares[i + 1]));
    return profile;
}

TEST_F(FieldVisibility, PointsMayBeAsNearASurfaceAsTheyLike)
{
    const FieldUpload uploaded(device(), {fieldOf({kFloor, box({3, 1, 0}, {1, 1, 1})})});
    for (const std::string_view method : {"QUILEZ", "ONE_CONE", "SUB_CONES"}) {
        std::vector<FieldAsk> asks;
        for (const float height : {1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f})
            asks.push_back({{0, height, 0}, {0, 5, 0}, 1, 7, uploaded[0]});
        for (const FieldSaid& each : runKernel<FieldSaid>(device(), kFieldKernel, method, asks))
            EXPECT_GT(each.value, 0.999f) << method;
    }
}

// A smooth penumbra's second difference is below 0.001 here. Cones find their narrowest place to a tolerance, which shows as steps of a
// part of one cone's share; where what blocks is thinner than a cone, whole cones turn dark at once.
TEST_F(FieldVisibility, PenumbrasHaveNoBands)
{
    for (const uint32_t cones : {1u, 4u, 7u, 16u}) {
        const float share = 1.0f / static_cast<float>(cones);
        EXPECT_LT(profileOf(device(), {box({2, 2, 0}, {2, 0.3f, 4})}, cones).roughest, std::max(0.03f, 0.2f * share)) << "edge " << cones;
        EXPECT_LT(profileOf(device(), {ball({0, 2, 0}, 0.5f)}, cones).roughest, 0.03) << "ball " << cones;
        EXPECT_LT(profileOf(device(), {box({2, 2, 0}, {2, 0.01f, 4})}, cones).roughest, 0.75 * share) << "sheet " << cones;
    }
}

/// Share of a disc of radius 1 up to `x` from its middle.
double discUpTo(double x)
{
    x = std::clamp(x, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

// Thinner than a cone: what is seen past both sides counts. Truth is the band that a rod hides of the light's disc.
TEST_F(FieldVisibility, ThinRodsHideABand)
{
    constexpr int kSteps = 81;
    for (const auto& [cones, bound] : {std::pair(1u, 0.05), std::pair(4u, 0.03), std::pair(7u, 0.02), std::pair(16u, 0.01)})
        for (const float radius : {0.01f, 0.03f, 0.06f}) {
            std::vector<FieldSteps> fields;
            std::vector<FieldAsk> asks;
            std::vector<double> truth;
            for (int i = 0; i < kSteps; ++i) {
                const float aside = -0.6f + 1.2f * static_cast<float>(i) / (kSteps - 1);
                fields.push_back(fieldOf({kFloor, rod({-4, 2.5f, aside}, {4, 2.5f, aside}, radius)}));
                asks.push_back({{0, 0.002f, 0}, {0, 5, 0}, 1, cones, {}});
                const double middle = std::atan2(aside, 2.498), half = std::asin(radius / std::hypot(2.498, aside)), sine = 1 / 4.998;
                truth.push_back(1 - discUpTo(std::sin(middle + half) / sine) + discUpTo(std::sin(middle - half) / sine));
            }
            const FieldUpload uploaded(device(), fields);
            for (int i = 0; i < kSteps; ++i)
                asks[i].fields = uploaded[i];
            const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, "SUB_CONES", asks);
            double sum = 0;
            for (int i = 0; i < kSteps; ++i)
                sum += std::pow(said[i].value - truth[i], 2);
            EXPECT_LT(std::sqrt(sum / kSteps), bound) << cones << " cones, " << radius << " m";
        }
}

// On floors that are no part of the field, far from all of it: right behind a post it is dark, beside it light.
TEST_F(FieldVisibility, PostsHideTheLightFromFloorsOfOtherThings)
{
    const FieldUpload uploaded(device(),
                               {fieldOf({{.shape = SDFShape::Capsule, .centre = {0, 0, 0}, .end = {0, 1, 0}, .radius = 0.055f}})});
    for (const uint32_t cones : {1u, 4u, 7u, 16u}) {
        std::vector<FieldAsk> asks;
        for (const vec3 position : {vec3(0.1f, 0, 0), vec3(0.2f, 0, 0), vec3(0.3f, 0, 0), vec3(0.2f, 0, 0.12f), vec3(0, 0, 0.3f)})
            asks.push_back({position, {-4, 4.5f, 0}, 0.55f, cones, uploaded[0]});
        const std::vector<FieldSaid> said = runKernel<FieldSaid>(device(), kFieldKernel, "SUB_CONES", asks);
        for (size_t i = 0; i < asks.size(); ++i)
            EXPECT_NEAR(said[i].value, i < 3 ? 0 : 1, 0.01) << cones << " cones, point " << i;
    }
}

TEST_F(FieldVisibility, ThinSheetsHideWhatIsBehindThem)
{
    constexpr uint32_t kCount = 200;
    RandomInputs random(22);
    for (const auto& [thickness, bound] : {std::pair(0.2f, 0.001), std::pair(0.06f, 0.1)}) {
        std::vector<FieldSteps> fields;
        std::vector<FieldAsk> asks;
        for (uint32_t i = 0; i < kCount; ++i) {
            fields.push_back(fieldOf({kFloor, box({0, static_cast<float>(random.uniform(1, 3)), 0}, {4, 0.5f * thickness, 4})}));
            asks.push_back({{static_cast<float>(random.uniform(-0.3, 0.3)), 0.002f, 0},
                            {static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.uniform(4.5, 6)), 0},
                            static_cast<float>(random.uniform(0.3, 1)),
                            7,
                            {}});
        }
        const FieldUpload uploaded(device(), fields);
        for (uint32_t i = 0; i < kCount; ++i)
            asks[i].fields = uploaded[i];
        double sum = 0;
        for (const FieldSaid& each : runKernel<FieldSaid>(device(), kFieldKernel, "SUB_CONES", asks))
            sum += each.value;
        EXPECT_LT(sum / kCount, bound) << thickness << " m";
    }
}

} // namespace
} // namespace antumbra
